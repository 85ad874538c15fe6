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
  const std::array<int, 4> around = primitives_around(primitives, place.px);
  const bool is_alone =
      std::all_of(around.begin(), around.end(), [&](int primitive) { return primitive == point.primitive; });
  if (is_alone && !is_ball(point.primitive)) return false;  // nearly always
  const Ray line{camera_m, point.in_world - camera_m};
  if (ball_is_before(scene, point.primitive, line, point)) return true;
  if (is_alone) return false;
  return std::any_of(around.begin(), around.end(),
                     [&](int primitive) { return ball_is_before(scene, primitive, line, point); }) ||
         scene.first_flat(line, kNear_m / place.in_camera.z(), 1.0 - kRounding, point.primitive) !=
             kNoPrimitive;
}

/// Follows pixels of one look to another.
/// @tparam Rays,Places PinholeRays and PinholePlaces, or those of any camera
template <class Rays, class Places>
class Follower {
 public:
  Follower(const SceneGeometry& scene, const IdBuffer& from, const IdBuffer& to)
      : scene_(scene),
        camera_m_(from.view.centre_in_world()),
        lines_(from.view),
        here_{from.view.camera_from_world, Places(from.view)},
        other_(to.primitive),
        other_camera_m_(to.view.centre_in_world()),
        other_intrinsics_(to.view.intrinsics),
        there_{to.view.camera_from_world, Places(to.view)} {
    if (!(to.view.lens == vision::Distortion{}))
      field_ = vision::directions_seen(to.view.lens, to.view.intrinsics);
  }

  /// Follows the pixels of a row that see one primitive.
  /// @param shifts_px set where the point has a place in the other picture's plane
  void follow(int primitive, int v, int begin, int end, cv::Vec2f* shifts_px, std::uint8_t* fates) const {
    const auto follow_all = [&](const auto& seen_by) {
      for (int u = begin; u < end; ++u)
        fates[u] = static_cast<std::uint8_t>(follow(primitive, seen_by(lines_(u, v)), shifts_px[u]));
    };
    if (primitive == kNoPrimitive)
      std::fill(fates + begin, fates + end, static_cast<std::uint8_t>(Occlusion::kNothing));
    else if (is_ball(primitive))
      follow_all([&](const Ray& ray) { return scene_.seen(primitive, ray); });
    else
      follow_all([look = SceneGeometry::FlatLook(scene_, primitive, camera_m_)](const Ray& ray) {
        return look.seen(ray);
      });
  }

 private:
  /// A camera that points are looked for with.
  struct Finder {
    Eigen::Isometry3d camera_from_world;
    Places place;
    PlaceOfPoint operator()(const Eigen::Vector3d& in_world) const {
      const Eigen::Vector3d in_camera = camera_from_world * in_world;
      return {in_camera, place(in_camera)};
    }
  };

  Occlusion follow(int primitive, const SceneGeometry::Seen& seen, cv::Vec2f& shift_px) const {
    const PlaceOfPoint there = there_(seen.on_ray);
    if (!(there.in_camera.z() > kNear_m) || is_beyond(there.in_camera)) return Occlusion::kOutside;
    const Eigen::Vector2f shift = (there.px - here_(seen.on_ray).px).template cast<float>();
    shift_px = {shift.x(), shift.y()};
    if (!vision::is_inside(other_intrinsics_, there.px)) return Occlusion::kOutside;
    const bool is_same = seen.on_primitive == seen.on_ray;  // nearly always
    return is_hidden(scene_, other_, other_camera_m_, {primitive, seen.on_primitive},
                     is_same ? there : there_(seen.on_primitive))
               ? Occlusion::kHidden
               : Occlusion::kSeen;
  }

  /// Whether a direction is none of those that the other picture shows: a lens may fold it into it.
  bool is_beyond(const Eigen::Vector3d& in_other) const {
    return field_ && !field_->contains(Eigen::Vector2d(in_other.hnormalized()));
  }

  const SceneGeometry& scene_;
  Eigen::Vector3d camera_m_;  // optical centre, world frame
  Rays lines_;
  Finder here_;
  const cv::Mat& other_;  // primitives
  Eigen::Vector3d other_camera_m_;
  vision::Intrinsics other_intrinsics_;
  Finder there_;
  std::optional<Eigen::AlignedBox2d> field_;  // of the other camera, where it has a lens
};

template <class Rays, class Places>
void follow_all(const SceneGeometry& scene, const IdBuffer& from, const IdBuffer& to,
                Correspondence& result) {
  const Follower<Rays, Places> follower(scene, from, to);
  for (int v = 0; v < from.primitive.rows; ++v) {
    auto* const shifts_px = result.shift_px.ptr<cv::Vec2f>(v);
    std::uint8_t* const fates = result.occlusion.ptr(v);
    for_runs(from.primitive.ptr<int>(v), from.primitive.cols, [&](int primitive, int begin, int end) {
      follower.follow(primitive, v, begin, end, shifts_px, fates);
    });
  }
}

}  // namespace

Correspondence correspond(const SceneGeometry& scene, const IdBuffer& from, const IdBuffer& to) {
  const cv::Size size = from.primitive.size();
  Correspondence result{cv::Mat(size, CV_32FC2, cv::Scalar::all(kUnknown_px)), cv::Mat(size, CV_8UC1)};
  if (is_straight(from.view) && is_straight(to.view))
    follow_all<PinholeRays, PinholePlaces>(scene, from, to, result);
  else
    follow_all<PixelRays, PixelPlaces>(scene, from, to, result);
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
