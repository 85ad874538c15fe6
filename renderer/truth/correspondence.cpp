#include "renderer/truth/correspondence.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "vision/camera/distortion.h"

namespace stereobench::renderer {
namespace {

constexpr float kUnknown_px = std::numeric_limits<float>::infinity();
constexpr double kRounding = 1e-9;  ///< relative; what meets a point may be the point itself

/// A point of a primitive, looked for from another camera.
struct PrimitivePoint {
  int primitive;
  Eigen::Vector3d in_world;
};

/// Whether a line that reaches a primitive's point at 1 meets another ball before it. A ball's own far side
/// is told by where it faces: at the rim its two sides are too near to each other.
bool ball_is_before(const SceneGeometry& scene, int primitive, const Ray& line, const PrimitivePoint& point) {
  if (!is_ball(primitive)) return false;
  if (primitive != point.primitive) return scene.enter(primitive, line) < 1.0 - kRounding;
  return scene.normal(primitive, point.in_world).dot(line.direction) > 0.0;
}

/// Where another look's camera has a point.
struct PlaceOfPoint {
  Eigen::Vector3d in_camera;
  Eigen::Vector2d px;  ///< only where it is before the camera
};

/// Walls and meshes may be thinner than a pixel, so that none of four pixels sees what is in the way: where
/// these see anything but the point's own primitive, all of them are asked.
bool is_hidden(const SceneGeometry& scene, const cv::Mat& primitives, const Eigen::Vector3d& camera_m,
               const PrimitivePoint& point, const PlaceOfPoint& place) {
  if (!(place.in_camera.z() > kNear_m)) return false;
  const Ray line{camera_m, point.in_world - camera_m};
  const std::array<int, 4> around = primitives_around(primitives, place.px);
  if (ball_is_before(scene, point.primitive, line, point)) return true;
  if (std::all_of(around.begin(), around.end(), [&](int primitive) { return primitive == point.primitive; }))
    return false;
  return std::any_of(around.begin(), around.end(),
                     [&](int primitive) { return ball_is_before(scene, primitive, line, point); }) ||
         scene.first_flat(line, kNear_m / place.in_camera.z(), 1.0 - kRounding, point.primitive) !=
             kNoPrimitive;
}

/// Follows pixels of one look to another.
class Follower {
 public:
  Follower(const SceneGeometry& scene, const IdBuffer& from, const IdBuffer& to)
      : scene_(scene),
        from_(from),
        to_(to),
        other_camera_m_(to.view.centre_in_world()),
        lines_(from.view),
        place_here_(from.view),
        place_there_(to.view) {
    if (!(to.view.lens == vision::Distortion{}))
      field_ = vision::directions_seen(to.view.lens, to.view.intrinsics);
  }

  /// @param primitive that the pixel sees
  /// @param shift_px set where the point has a place in the other picture's plane
  Occlusion follow(int primitive, int u, int v, cv::Vec2f& shift_px) const {
    if (primitive == kNoPrimitive) return Occlusion::kNothing;
    const SceneGeometry::Seen seen = scene_.seen(primitive, lines_(u, v));
    const PlaceOfPoint there = place_there(seen.on_ray);
    if (!(there.in_camera.z() > kNear_m) || is_beyond(there.in_camera)) return Occlusion::kOutside;
    const Eigen::Vector2d here = place_here_(from_.view.camera_from_world * seen.on_ray);
    const Eigen::Vector2f shift = (there.px - here).cast<float>();
    shift_px = {shift.x(), shift.y()};
    if (!vision::is_inside(to_.view.intrinsics, there.px)) return Occlusion::kOutside;
    const bool is_same = seen.on_primitive == seen.on_ray;  // nearly always
    return is_hidden(scene_, to_.primitive, other_camera_m_, {primitive, seen.on_primitive},
                     is_same ? there : place_there(seen.on_primitive))
               ? Occlusion::kHidden
               : Occlusion::kSeen;
  }

 private:
  PlaceOfPoint place_there(const Eigen::Vector3d& in_world) const {
    const Eigen::Vector3d in_camera = to_.view.camera_from_world * in_world;
    return {in_camera, place_there_(in_camera)};
  }

  /// Whether a direction is none of those that the other picture shows: a lens may fold it into it.
  bool is_beyond(const Eigen::Vector3d& in_other) const {
    return field_ && !field_->contains(Eigen::Vector2d(in_other.hnormalized()));
  }

  const SceneGeometry& scene_;
  const IdBuffer& from_;
  const IdBuffer& to_;
  Eigen::Vector3d other_camera_m_;  // optical centre, world frame
  PixelRays lines_;
  PixelPlaces place_here_, place_there_;
  std::optional<Eigen::AlignedBox2d> field_;  // of the other camera, where it has a lens
};

}  // namespace

Correspondence correspond(const SceneGeometry& scene, const IdBuffer& from, const IdBuffer& to) {
  const cv::Size size = from.primitive.size();
  Correspondence result{cv::Mat(size, CV_32FC2, cv::Scalar::all(kUnknown_px)), cv::Mat(size, CV_8UC1)};
  const Follower follower(scene, from, to);
  for (int v = 0; v < size.height; ++v) {
    const int* primitives = from.primitive.ptr<int>(v);
    auto* shifts_px = result.shift_px.ptr<cv::Vec2f>(v);
    std::uint8_t* occlusions = result.occlusion.ptr(v);
    for (int u = 0; u < size.width; ++u)
      occlusions[u] = static_cast<std::uint8_t>(follower.follow(primitives[u], u, v, shifts_px[u]));
  }
  return result;
}

cv::Mat disparity_px(const Correspondence& to_other_camera, vision::Side side) {
  cv::Mat columns;
  cv::extractChannel(to_other_camera.shift_px, columns, 0);
  cv::Mat disparity = side == vision::Side::kLeft ? cv::Mat(-columns) : columns;
  disparity.setTo(kUnknown_px, columns == kUnknown_px);
  return disparity;
}

}  // namespace stereobench::renderer
