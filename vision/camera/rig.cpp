#include "vision/camera/rig.h"

#include <cmath>

#include "slam/math/elementary.h"
#include "vision/camera/distortion.h"

namespace stereobench::vision {
namespace {

/// R = Rx Ry Rz.
Eigen::Matrix3d rotation(const Eigen::Vector3d& turn_rad) {
  Eigen::Matrix3d result = Eigen::Matrix3d::Identity();
  for (int axis = 0; axis < 3; ++axis) {
    const auto [s, c] = slam::sine_cosine(turn_rad[axis]);
    const int j = (axis + 1) % 3;
    const int k = (axis + 2) % 3;
    Eigen::Matrix3d about_axis = Eigen::Matrix3d::Identity();
    about_axis(j, j) = about_axis(k, k) = c;
    about_axis(j, k) = -s;
    about_axis(k, j) = s;
    result = result * about_axis;
  }
  return result;
}

bool is_usable(const Distortion& lens) {
  return std::isfinite(lens.k1) && std::isfinite(lens.k2) && std::isfinite(lens.p1) &&
         std::isfinite(lens.p2) && std::isfinite(lens.k3) && std::isfinite(lens.pixel_aspect) &&
         lens.pixel_aspect > 0.0;
}

}  // namespace

Eigen::Isometry3d robot_from_camera(const StereoRig& rig, Side side) {
  const auto [sin_pitch, cos_pitch] = slam::sine_cosine(rig.pitch_down_rad);
  const double sign = side == Side::kLeft ? 0.5 : -0.5;
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.linear().col(0) = Eigen::Vector3d(0.0, -1.0, 0.0);               // right
  result.linear().col(1) = Eigen::Vector3d(-sin_pitch, 0.0, -cos_pitch);  // down
  result.linear().col(2) = Eigen::Vector3d(cos_pitch, 0.0, -sin_pitch);   // forward
  result.translation() = Eigen::Vector3d(0.0, sign * rig.baseline_m, rig.height_m);
  if (side == Side::kRight) result.linear() *= rotation(rig.right_turn_rad);
  return result;
}

Eigen::Vector3d camera_point(const StereoRig& rig, const Eigen::Vector3d& point_in_left_camera, Side side) {
  if (side == Side::kLeft) return point_in_left_camera;
  return camera_direction(rig, point_in_left_camera - Eigen::Vector3d(rig.baseline_m, 0.0, 0.0), side);
}

Eigen::Vector3d camera_direction(const StereoRig& rig, const Eigen::Vector3d& direction_in_left_camera,
                                 Side side) {
  if (side == Side::kLeft) return direction_in_left_camera;
  return rotation(rig.right_turn_rad).transpose() * direction_in_left_camera;
}

Eigen::Vector2d image_point(const StereoRig& rig, const Eigen::Vector3d& point_in_camera) {
  return project(rig.intrinsics, distort(rig.distortion, point_in_camera.hnormalized()).homogeneous());
}

std::optional<Eigen::Vector2d> pinhole_point(const StereoRig& rig, const Eigen::Vector2d& taken_px) {
  if (rig.distortion == Distortion{}) return taken_px;
  const auto direction = undistort(rig.distortion, pixel_ray(rig.intrinsics, taken_px).head<2>());
  if (!direction) return std::nullopt;
  return project(rig.intrinsics, direction->homogeneous());
}

std::optional<Eigen::Vector2d> rectified_point(const StereoRig& rig, const Eigen::Vector2d& taken_px,
                                               Side side) {
  const auto pinhole_px = pinhole_point(rig, taken_px);
  if (!pinhole_px || side == Side::kLeft || rig.right_turn_rad.isZero(0.0)) return pinhole_px;
  const Eigen::Vector3d direction = rotation(rig.right_turn_rad) * pixel_ray(rig.intrinsics, *pinhole_px);
  if (!(direction.z() > 0.0)) return std::nullopt;
  return project(rig.intrinsics, direction);
}

std::optional<Eigen::Vector2d> project_if_visible(const Intrinsics& camera,
                                                  const Eigen::Vector3d& point_in_camera) {
  if (!(point_in_camera.z() > 0.0)) return std::nullopt;
  const Eigen::Vector2d pixel = project(camera, point_in_camera);
  return is_inside(camera, pixel) ? std::optional(pixel) : std::nullopt;
}

bool is_usable(const StereoRig& rig) {
  const auto positive = [](double value) { return std::isfinite(value) && value > 0.0; };
  return rig.intrinsics.width_px > 0 && rig.intrinsics.height_px > 0 && positive(rig.intrinsics.focal_px) &&
         positive(rig.baseline_m) && std::isfinite(rig.intrinsics.cx_px) &&
         std::isfinite(rig.intrinsics.cy_px) && std::isfinite(rig.height_m) &&
         std::isfinite(rig.pitch_down_rad) && rig.right_turn_rad.allFinite() && is_usable(rig.distortion);
}

}  // namespace stereobench::vision
