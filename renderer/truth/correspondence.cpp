#include "renderer/truth/correspondence.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>

#include "renderer/truth/flat_row.h"
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

/// Whether four pixels all see one primitive.
bool is_alone(const std::array<int, 4>& around, int primitive) {
  return around[0] == primitive && around[1] == primitive && around[2] == primitive && around[3] == primitive;
}

/// Walls and meshes may be thinner than a pixel, so that none of four pixels sees what is in the way: where
/// these see anything but the point's own primitive, all of them are asked.
bool is_hidden(const SceneGeometry& scene, const cv::Mat& primitives, const Eigen::Vector3d& camera_m,
               const PrimitivePoint& point, const PlaceOfPoint& place) {
  if (!(place.in_camera.z() > kNear_m)) return false;
  const std::array<int, 4> around = primitives_around(primitives, place.px);
  const bool alone = is_alone(around, point.primitive);
  if (alone && !is_ball(point.primitive)) return false;
  const Ray line{camera_m, point.in_world - camera_m};
  if (ball_is_before(scene, point.primitive, line, point)) return true;
  if (alone) return false;
  return std::any_of(around.begin(), around.end(),
                     [&](int primitive) { return ball_is_before(scene, primitive, line, point); }) ||
         scene.first_flat(line, kNear_m / place.in_camera.z(), 1.0 - kRounding, point.primitive) !=
             kNoPrimitive;
}

/// One row of what is found.
struct ResultRow {
  cv::Vec2f* shifts_px;
  Occlusion* fates;
};

/// Where another pinhole camera shows what a row sees of a flat. For a ray r with z = 1 and its inverse depth
/// w the other camera has r + e before it, e = (R - 1) r + w t.
class RowShift {
 public:
  RowShift(const PinholeLook& from, const PinholeLook& to, int row, const AlongRow& inverse_depth)
      : focal_px_(to.intrinsics.focal_px),
        x_(Eigen::Vector3d::UnitX(), from.intrinsics, row),
        y_((row - from.intrinsics.cy_px) / from.intrinsics.focal_px) {
    const Eigen::Matrix3d turn_less_1 = (to.turn - from.turn) * from.turn.transpose();
    const Eigen::Vector3d way = to.turn * (from.centre_m - to.centre_m);
    const auto along_row = [&](int axis) {
      return AlongRow(turn_less_1.row(axis), from.intrinsics, row) + way[axis] * inverse_depth;
    };
    ex_ = along_row(0);
    ey_ = along_row(1);
    ez_ = along_row(2);
    room_ = AlongRow(1.0, 0.0) + ez_ - kNear_m * inverse_depth;
    const double longer_px = to.intrinsics.focal_px - from.intrinsics.focal_px;
    other_x_ = longer_px * x_ + AlongRow(to.intrinsics.cx_px - from.intrinsics.cx_px, 0.0);
    other_y_ = longer_px * y_ + to.intrinsics.cy_px - from.intrinsics.cy_px;
  }

  /// Whether all of some columns are before the other camera.
  bool is_ahead(const cv::Range& columns) const {
    return room_(columns.start) > 0.0 && room_(columns.end - 1) > 0.0;
  }

  /// The place in the other picture less that in this one.
  Eigen::Vector2d operator()(double column) const {
    const double x = x_(column), ez = ez_(column), scale = focal_px_ / (1.0 + ez);
    return {(ex_(column) - x * ez) * scale + other_x_(column), (ey_(column) - y_ * ez) * scale + other_y_};
  }

 private:
  double focal_px_;
  AlongRow x_;
  double y_;
  AlongRow ex_, ey_, ez_, room_;  // room: before the near plane, divided by the depth
  AlongRow other_x_;              // by other intrinsics
  double other_y_;
};

/// Follows pixels of one look to another.
/// @tparam Rays,Places PinholeRays and PinholePlaces, or those of any camera
template <class Rays, class Places>
class Follower {
 public:
  Follower(const SceneGeometry& scene, const IdBuffer& from, const IdBuffer& to)
      : scene_(scene),
        camera_(from.view),
        lines_(from.view),
        here_{from.view.camera_from_world, Places(from.view)},
        other_(to.primitive),
        other_camera_(to.view),
        there_{to.view.camera_from_world, Places(to.view)} {
    if (!(to.view.lens == vision::Distortion{}))
      field_ = vision::directions_seen(to.view.lens, to.view.intrinsics);
  }

  /// Follows the pixels of a row that see one primitive.
  void follow(int primitive, int v, int begin, int end, const ResultRow& row) const {
    if (primitive == kNoPrimitive) {
      std::fill(row.shifts_px + begin, row.shifts_px + end, cv::Vec2f(kUnknown_px, kUnknown_px));
      std::fill(row.fates + begin, row.fates + end, Occlusion::kNothing);
      return;
    }
    cv::Range swept(begin, begin);
    if constexpr (std::is_same_v<Rays, PinholeRays>)
      if (!is_ball(primitive)) swept = sweep(primitive, v, {begin, end}, row);
    for (int u = begin; u < swept.start; ++u) follow(primitive, u, v, row);
    for (int u = swept.end; u < end; ++u) follow(primitive, u, v, row);
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

  /// Follows all that meet a flat primitive, in the same steps. @return which these are
  cv::Range sweep(int primitive, int v, const cv::Range& columns, const ResultRow& row) const {
    const SceneGeometry::FlatRow flat(scene_, primitive, camera_, v);
    const cv::Range met = flat.columns_on_it(columns);
    if (met.empty()) return met;
    const RowShift shift(camera_, other_camera_, v, flat.inverse_depth());
    if (!shift.is_ahead(met)) return {columns.start, columns.start};
    constexpr int kAtOnce = 256;
    double x_px[kAtOnce], y_px[kAtOnce];  // places in the other picture
    for (int first = met.start; first < met.end; first += kAtOnce) {
      const int count = std::min(kAtOnce, met.end - first);
      for (int i = 0; i < count; ++i) {
        const Eigen::Vector2d moved = shift(first + i);
        row.shifts_px[first + i] = {static_cast<float>(moved.x()), static_cast<float>(moved.y())};
        x_px[i] = first + i + moved.x();
        y_px[i] = v + moved.y();
      }
      for (int i = 0; i < count; ++i) {
        const Eigen::Vector2d place(x_px[i], y_px[i]);
        if (!vision::is_inside(other_camera_.intrinsics, place))
          row.fates[first + i] = Occlusion::kOutside;
        else if (is_alone(primitives_around(other_, place), primitive))
          row.fates[first + i] = Occlusion::kSeen;
        else
          follow(primitive, first + i, v, row);
      }
    }
    return met;
  }

  void follow(int primitive, int u, int v, const ResultRow& row) const {
    row.shifts_px[u] = {kUnknown_px, kUnknown_px};
    row.fates[u] = fate(primitive, scene_.seen(primitive, lines_(u, v)), row.shifts_px[u]);
  }

  /// @param shift_px set where the point has a place in the other picture's plane
  Occlusion fate(int primitive, const SceneGeometry::Seen& seen, cv::Vec2f& shift_px) const {
    const PlaceOfPoint there = there_(seen.on_ray);
    if (!(there.in_camera.z() > kNear_m) || is_beyond(there.in_camera)) return Occlusion::kOutside;
    const Eigen::Vector2f shift = (there.px - here_(seen.on_ray).px).template cast<float>();
    shift_px = {shift.x(), shift.y()};
    if (!vision::is_inside(other_camera_.intrinsics, there.px)) return Occlusion::kOutside;
    const bool is_same = seen.on_primitive == seen.on_ray;  // nearly always
    return is_hidden(scene_, other_, other_camera_.centre_m, {primitive, seen.on_primitive},
                     is_same ? there : there_(seen.on_primitive))
               ? Occlusion::kHidden
               : Occlusion::kSeen;
  }

  /// Whether a direction is none of those that the other picture shows: a lens may fold it into it.
  bool is_beyond(const Eigen::Vector3d& in_other) const {
    return field_ && !field_->contains(Eigen::Vector2d(in_other.hnormalized()));
  }

  const SceneGeometry& scene_;
  PinholeLook camera_;
  Rays lines_;
  Finder here_;
  const cv::Mat& other_;  // primitives
  PinholeLook other_camera_;
  Finder there_;
  std::optional<Eigen::AlignedBox2d> field_;  // of the other camera, where it has a lens
};

template <class Rays, class Places>
void follow_all(const SceneGeometry& scene, const IdBuffer& from, const IdBuffer& to,
                Correspondence& result) {
  const Follower<Rays, Places> follower(scene, from, to);
  for (int v = 0; v < from.primitive.rows; ++v) {
    const ResultRow row = {result.shift_px.ptr<cv::Vec2f>(v), result.occlusion.ptr<Occlusion>(v)};
    for_runs(from.primitive.ptr<int>(v), from.primitive.cols,
             [&](int primitive, int begin, int end) { follower.follow(primitive, v, begin, end, row); });
  }
}

}  // namespace

Correspondence correspond(const SceneGeometry& scene, const IdBuffer& from, const IdBuffer& to) {
  const cv::Size size = from.primitive.size();
  Correspondence result{cv::Mat(size, CV_32FC2), cv::Mat(size, CV_8UC1)};
  if (is_straight(from.view) && is_straight(to.view))
    follow_all<PinholeRays, PinholePlaces>(scene, from, to, result);
  else
    follow_all<PixelRays, PixelPlaces>(scene, from, to, result);
  return result;
}

cv::Mat disparity_px(const Correspondence& to_other_camera, vision::Side side) {
  cv::Mat disparity;
  cv::extractChannel(to_other_camera.shift_px, disparity, 0);
  if (side == vision::Side::kRight) return disparity;
  std::transform(disparity.begin<float>(), disparity.end<float>(), disparity.begin<float>(),
                 [](float shift_px) { return shift_px == kUnknown_px ? kUnknown_px : -shift_px; });
  return disparity;
}

}  // namespace stereobench::renderer
