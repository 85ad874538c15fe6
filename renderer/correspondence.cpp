#include "renderer/correspondence.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "vision/distortion.h"

namespace stereobench::renderer {
namespace {

constexpr float kUnknown_px = std::numeric_limits<float>::infinity();
constexpr double kRounding = 1e-9;  ///< relative; what meets a point may be the point itself

/// A facet's point in both eyes' frames.
struct Point {
  int facet;
  Eigen::Vector3d in_world;
  Eigen::Vector2d place_px;  ///< in the picture it is looked for in
};

/// Whether a line from the other eye, which reaches the point at 1, meets a facet before it. A ball's own far
/// side is told by where it faces: at the rim its two sides are too near to each other.
bool is_before(const SceneGeometry& scene, int facet, const Sightline& line, const Point& point) {
  if (facet == kNoFacet) return false;
  if (facet != point.facet) return scene.enter(facet, line) < 1.0 - kRounding;
  return is_ball(facet) && scene.normal(facet, point.in_world).dot(line.direction) > 0.0;
}

/// @param eye_m where the other eye is, world frame
bool is_hidden(const SceneGeometry& scene, const cv::Mat& facets, const Eigen::Vector3d& eye_m,
               const Point& point) {
  const Sightline line{eye_m, point.in_world - eye_m};
  if (is_before(scene, point.facet, line, point)) return true;
  const std::array<int, 4> around = facets_around(facets, point.place_px);
  return std::any_of(around.begin(), around.end(),
                     [&](int facet) { return facet != point.facet && is_before(scene, facet, line, point); });
}

/// Follows pixels of one look to another.
class Follower {
 public:
  Follower(const SceneGeometry& scene, const EyeSight& from, const EyeSight& to)
      : scene_(scene), from_(from), to_(to), lines_(from.view), other_eye_m_(to.view.centre_in_world()) {
    if (!(to.view.lens == vision::Distortion{}))
      field_ = vision::directions_seen(to.view.lens, to.view.camera);
  }

  /// @param facet that the pixel sees
  /// @param shift_px set where the point has a place in the other picture's plane
  Fate follow(int facet, int u, int v, cv::Vec2f& shift_px) const {
    if (facet == kNoFacet) return Fate::kNothing;
    const Eigen::Vector3d point = scene_.seen_point(facet, lines_(u, v));
    const Eigen::Vector3d in_other = to_.view.camera_from_world * point;
    if (!(in_other.z() > kNear_m) || is_beyond(in_other)) return Fate::kOutside;
    const Eigen::Vector2d there = shown_at(to_.view, in_other);
    const Eigen::Vector2d here = shown_at(from_.view, from_.view.camera_from_world * point);
    const Eigen::Vector2f shift = (there - here).cast<float>();
    shift_px = {shift.x(), shift.y()};
    if (!vision::is_inside(to_.view.camera, there)) return Fate::kOutside;
    return is_hidden(scene_, to_.facet, other_eye_m_, {facet, point, there}) ? Fate::kHidden : Fate::kSeen;
  }

 private:
  /// Whether a direction is none of those that the other picture shows: a lens may fold it into it.
  bool is_beyond(const Eigen::Vector3d& in_other) const {
    return field_ && !field_->contains(Eigen::Vector2d(in_other.hnormalized()));
  }

  const SceneGeometry& scene_;
  const EyeSight& from_;
  const EyeSight& to_;
  Sightlines lines_;
  Eigen::Vector3d other_eye_m_;
  std::optional<Eigen::AlignedBox2d> field_;  // of the other eye, where it has a lens
};

}  // namespace

Correspondence correspond(const SceneGeometry& scene, const EyeSight& from, const EyeSight& to) {
  const cv::Size size = from.facet.size();
  Correspondence result{cv::Mat(size, CV_32FC2, cv::Scalar::all(kUnknown_px)), cv::Mat(size, CV_8UC1)};
  const Follower follower(scene, from, to);
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      const Fate fate = follower.follow(from.facet.at<int>(v, u), u, v, result.shift_px.at<cv::Vec2f>(v, u));
      result.fate.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(fate);
    }
  }
  return result;
}

cv::Mat disparity_px(const Correspondence& to_other_eye, vision::Eye eye) {
  cv::Mat columns;
  cv::extractChannel(to_other_eye.shift_px, columns, 0);
  cv::Mat disparity = eye == vision::Eye::kLeft ? cv::Mat(-columns) : columns;
  disparity.setTo(kUnknown_px, columns == kUnknown_px);
  return disparity;
}

}  // namespace stereobench::renderer
