#include "harness/rig_calibration/rectified_rig.h"

#include <algorithm>
#include <stdexcept>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "vision/camera/distortion.h"
#include "vision/camera/rig.h"

namespace stereobench::harness {
namespace {

Eigen::Matrix3d rotation_of(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  return angle > 0.0 ? Eigen::AngleAxisd(angle, vector / angle).matrix() : Eigen::Matrix3d::Identity();
}

/// @throws as rectified_rig
vision::CameraModel camera_model(const CameraParameters& p, int width_px, int height_px) {
  vision::CameraModel camera;
  camera.intrinsics = {width_px, height_px, p[0], p[1], p[2]};
  camera.lens = {.k1 = p[3], .k2 = p[4], .p1 = p[5], .p2 = p[6], .k3 = p[kK3], .pixel_aspect = p[kAspect]};
  if (!vision::is_usable(camera))
    throw std::runtime_error(
        fmt::format("the lens that fits best (k1 {:.3g}, k2 {:.3g}, k3 {:.3g}) folds the picture's corners: "
                    "show the board "
                    "nearer to them, or estimate other coefficients",
                    p[3], p[4], p[kK3]));
  return camera;
}

/// The frame with its x axis along the baseline, and z as near as may be to that of the cameras' common
/// frame.
Eigen::Matrix3d rectified_from_common(const Eigen::Vector3d& baseline) {
  Eigen::Matrix3d rows;
  const Eigen::Vector3d x = baseline.normalized();
  const Eigen::Vector3d y = Eigen::Vector3d::UnitZ().cross(x).normalized();
  rows << x.transpose(), y.transpose(), x.cross(y).transpose();
  return rows;
}

void check_sides(const Eigen::Vector3d& right) {
  const double across = std::max(std::abs(right.y()), std::abs(right.z()));
  if (std::abs(right.x()) <= across)
    throw std::runtime_error(fmt::format(
        "the cameras are not side by side: the right one is at ({:.4g}, {:.4g}, {:.4g}) m of the left one",
        right.x(), right.y(), right.z()));
  if (right.x() < 0.0)
    throw std::runtime_error(fmt::format(
        "left and right are swapped: the right camera is {:.4g} m to the left of the left one", -right.x()));
}

}  // namespace

RigCalibration rectified_rig(const RigFit& fit, RigModel model, int width_px, int height_px) {
  check_sides(fit.right_in_left_m);
  RigCalibration result;
  vision::StereoRig& rig = result.rig;
  rig.height_m = 0.0;
  rig.baseline_m = fit.right_in_left_m.norm();
  vision::CameraPair cameras = {camera_model(fit.cameras[0], width_px, height_px),
                                camera_model(fit.cameras[1], width_px, height_px)};
  const Eigen::Matrix3d left_from_right = rotation_of(fit.turn_rad);
  if (model == RigModel::kOneCamera) {
    rig.intrinsics = cameras[0].intrinsics;
    rig.distortion = cameras[0].lens;
    rig.right_turn_rad = turn_angles(left_from_right);
    return result;
  }
  const Eigen::Matrix3d half = rotation_of(0.5 * fit.turn_rad);
  const Eigen::Matrix3d turned = rectified_from_common(half.transpose() * fit.right_in_left_m);
  cameras[0].rectified_from_camera = turned * half.transpose();
  cameras[1].rectified_from_camera = turned * half;
  const Eigen::Vector3d mean = 0.5 * (fit.cameras[0] + fit.cameras[1]).head<3>();
  rig.intrinsics = {width_px, height_px, mean[0], mean[1], mean[2]};
  result.cameras = cameras;
  return result;
}

std::optional<Eigen::Vector2d> rectified_px(const RigCalibration& calibration,
                                            const Eigen::Vector2d& taken_px, vision::Side side) {
  const vision::CameraPair cameras =
      calibration.cameras ? *calibration.cameras : vision::cameras_of(calibration.rig);
  const vision::CameraModel& taken_by = cameras[static_cast<std::size_t>(side)];
  const auto direction =
      vision::undistort(taken_by.lens, vision::pixel_ray(taken_by.intrinsics, taken_px).head<2>());
  if (!direction) return std::nullopt;
  const Eigen::Vector3d turned = taken_by.rectified_from_camera * direction->homogeneous();
  return vision::project(calibration.rig.intrinsics, turned);
}

}  // namespace stereobench::harness
