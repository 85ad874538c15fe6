/// A floor, wall or triangle along a row of a picture without distortion. For the ray r with z = 1 from the
/// optical centre o, the plane n . (X - c) = 0 is met at the inverse depth n . r / n . (c - o): this, and
/// where on the plane, divided by the depth, are linear in the column.
#pragma once

#include <array>

#include "renderer/truth/scene_geometry.h"

namespace stereobench::renderer {

/// A pinhole camera: what its rows share.
struct PinholeLook {
  explicit PinholeLook(const CameraView& view)
      : intrinsics(view.intrinsics),
        turn(view.camera_from_world.linear()),
        centre_m(view.centre_in_world()) {}

  vision::Intrinsics intrinsics;
  Eigen::Matrix3d turn;      ///< camera from world
  Eigen::Vector3d centre_m;  ///< optical centre, world frame
};

/// A number that is linear in the column. Rounded, too, it is nowhere between two columns beyond what it is
/// at both.
struct AlongRow {
  AlongRow() = default;
  AlongRow(double start, double each) : at_0(start), per_px(each) {}

  /// q . r of the rays of a row. @param in_camera q
  AlongRow(const Eigen::Vector3d& in_camera, const vision::Intrinsics& camera, int row)
      : at_0(in_camera.z() +
             (in_camera.y() * (row - camera.cy_px) - in_camera.x() * camera.cx_px) / camera.focal_px),
        per_px(in_camera.x() / camera.focal_px) {}

  double operator()(double column) const { return at_0 + per_px * column; }
  friend AlongRow operator+(const AlongRow& a, const AlongRow& b) {
    return {a.at_0 + b.at_0, a.per_px + b.per_px};
  }
  friend AlongRow operator-(const AlongRow& a, const AlongRow& b) {
    return {a.at_0 - b.at_0, a.per_px - b.per_px};
  }
  friend AlongRow operator*(double factor, const AlongRow& a) { return {factor * a.at_0, factor * a.per_px}; }

  double at_0 = 0.0;
  double per_px = 0.0;
};

class SceneGeometry::FlatRow {
 public:
  /// @param primitive that is no ball
  FlatRow(const SceneGeometry& scene, int primitive, const PinholeLook& camera, int row);

  /// Those of some columns whose rays meet the primitive before the camera.
  cv::Range columns_on_it(cv::Range columns) const {
    while (columns.start < columns.end && !meets(columns.start)) ++columns.start;
    while (columns.start < columns.end && !meets(columns.end - 1)) --columns.end;
    return columns;
  }

  /// 1 / Z of what the rays meet, 1/m.
  const AlongRow& inverse_depth() const { return inverse_depth_; }

 private:
  bool meets(double column) const {
    for (const AlongRow& room : room_)
      if (!(room(column) >= 0.0)) return false;
    return inverse_depth_(column) > 0.0;
  }

  AlongRow inverse_depth_;
  std::array<AlongRow, 4> room_;  // to the primitive's bounds, divided by the depth
};

}  // namespace stereobench::renderer
