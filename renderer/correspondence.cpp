#include "renderer/correspondence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

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

std::array<int, 4> facets_around(const cv::Mat& facets, const Eigen::Vector2d& place_px) {
  const auto near = [](double coordinate, int size) {
    const int low = static_cast<int>(std::floor(coordinate));
    return std::array{std::clamp(low, 0, size - 1), std::clamp(low + 1, 0, size - 1)};
  };
  const auto [left, right] = near(place_px.x(), facets.cols);
  const auto [above, below] = near(place_px.y(), facets.rows);
  return {facets.at<int>(above, left), facets.at<int>(above, right), facets.at<int>(below, left),
          facets.at<int>(below, right)};
}

/// Whether a line from the other eye, which reaches the point at 1, meets a facet before it. A ball's own far
/// side is told by where it faces: at the rim its two sides are too near to each other.
bool is_before(const SceneGeometry& scene, int facet, const Sightline& line, const Point& point) {
  if (facet == kNoFacet) return false;
  if (facet != point.facet) return scene.enter(facet, line) < 1.0 - kRounding;
  return is_ball(facet) && scene.normal(facet, point.in_world).dot(line.direction) > 0.0;
}

bool is_hidden(const SceneGeometry& scene, const EyeSight& by, const Point& point) {
  const Eigen::Vector3d eye = by.view.centre_in_world();
  const Sightline line{eye, point.in_world - eye};
  if (is_before(scene, point.facet, line, point)) return true;
  const std::array<int, 4> around = facets_around(by.facet, point.place_px);
  return std::any_of(around.begin(), around.end(),
                     [&](int facet) { return is_before(scene, facet, line, point); });
}

}  // namespace

Correspondence correspond(const SceneGeometry& scene, const EyeSight& from, const EyeSight& to) {
  const cv::Size size = from.facet.size();
  Correspondence result{cv::Mat(size, CV_32FC2, cv::Scalar::all(kUnknown_px)),
                        cv::Mat(size, CV_8UC1, cv::Scalar(0))};
  const Sightlines lines(from.view);
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      const int facet = from.facet.at<int>(v, u);
      if (facet == kNoFacet) continue;
      Fate& fate = *reinterpret_cast<Fate*>(result.fate.ptr(v, u));
      fate = Fate::kOutside;
      const Eigen::Vector3d point = scene.seen_point(facet, lines(u, v));
      const Eigen::Vector3d in_other = to.view.camera_from_world * point;
      if (!(in_other.z() > kNear_m)) continue;
      const Eigen::Vector2d place = vision::project(to.view.camera, in_other);
      const Eigen::Vector2f shift =
          (place - vision::project(from.view.camera, from.view.camera_from_world * point)).cast<float>();
      result.shift_px.at<cv::Vec2f>(v, u) = {shift.x(), shift.y()};
      if (!vision::project_if_visible(to.view.camera, in_other)) continue;
      fate = is_hidden(scene, to, {facet, point, place}) ? Fate::kHidden : Fate::kSeen;
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
