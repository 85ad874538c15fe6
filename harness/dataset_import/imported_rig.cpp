#include "harness/dataset_import/imported_rig.h"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/dataset_import/few_decimals.h"
#include "harness/rig_calibration/rectified_rig.h"
#include "slam/math/angles.h"
#include "slam/math/elementary.h"
#include "vision/camera/rig.h"

namespace stereobench::harness {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

bool is_same(const ViewCamera& one, const ViewCamera& other) {
  const vision::Intrinsics &a = one.pinhole, &b = other.pinhole;
  return a.focal_px == b.focal_px && a.cx_px == b.cx_px && a.cy_px == b.cy_px && one.lens == other.lens;
}

bool is_rigid(const Isometry3d& place) {
  constexpr double kDecimals = 1e-3;  // of somebody's file
  const Matrix3d turn = place.linear();
  return place.matrix().allFinite() && turn.isUnitary(kDecimals) && turn.determinant() > 0.0;
}

/// A place between cameras that runs along the left one's rows, but for the rounding of a file.
bool is_along_rows(const Vector3d& right_in_left_m) {
  constexpr double kRounding = 1e-9;
  return right_in_left_m.tail<2>().norm() <= kRounding * right_in_left_m.x();
}

CameraParameters parameters_of(const ViewCamera& camera) {
  const auto& [pinhole, lens, place] = camera;
  CameraParameters p;
  p << pinhole.focal_px, pinhole.cx_px, pinhole.cy_px, lens.k1, lens.k2, lens.p1, lens.p2, lens.k3,
      lens.pixel_aspect;
  return p;
}

RigCalibration rig_of_two(const std::array<ViewCamera, 2>& cameras, const Vector3d& right_in_left_m,
                          const Matrix3d& left_from_right) {
  RigFit fit;
  for (std::size_t i = 0; i < 2; ++i) fit.cameras[i] = parameters_of(cameras[i]);
  fit.right_in_left_m = right_in_left_m;
  const Eigen::AngleAxisd turn(left_from_right);
  fit.turn_rad = turn.angle() * turn.axis();
  const vision::Intrinsics& size = cameras[0].pinhole;
  return rectified_rig(fit, RigModel::kTwoCameras, size.width_px, size.height_px);
}

/// An angle that came through a quaternion or a matrix, without the last digits that this cost.
double in_short_degrees(double angle_rad) {
  constexpr double kRounding_rad = 1e-14;
  const double degrees = angle_rad * slam::kDegreesPerRad;
  const double shorter = in_few_decimals(degrees, kRounding_rad * slam::kDegreesPerRad);
  return shorter == degrees ? angle_rad + 0.0 : shorter * slam::kRadPerDegree;  // -0 becomes 0
}

/// Takes height and pitch from a body that is a robot.
void stand_on(const Isometry3d& body_from_rectified, vision::StereoRig& rig) {
  constexpr double kUpright = 1e-6;
  const Matrix3d axes = body_from_rectified.linear();
  const bool is_robot = (axes.col(0) + Vector3d::UnitY()).norm() <= kUpright && axes(0, 2) > 0.0;
  rig.height_m = is_robot ? body_from_rectified.translation().z() : 0.0;
  rig.pitch_down_rad = is_robot ? in_short_degrees(slam::arc_tangent(-axes(2, 2), axes(0, 2))) : 0.0;
}

/// The left camera's place, with the axes of its rectified picture.
Isometry3d body_from_rectified(const RigCalibration& calibration, const ViewCamera& left) {
  Isometry3d place = left.body_from_camera;
  if (calibration.cameras) place.linear() *= calibration.cameras->front().rectified_from_camera.transpose();
  return place;
}

}  // namespace

RigCalibration imported_rig(const std::array<ViewCamera, 2>& cameras) {
  for (const ViewCamera& camera : cameras) {
    if (!is_rigid(camera.body_from_camera))
      throw std::runtime_error("expected a camera's place on the body: a rotation and a shift");
    if (!vision::is_usable(vision::CameraModel{.intrinsics = camera.pinhole, .lens = camera.lens}))
      throw std::runtime_error(
          "expected finite numbers, a positive focal length and a lens that does not fold its picture");
  }
  const Isometry3d &left = cameras[0].body_from_camera, &right = cameras[1].body_from_camera;
  const Vector3d between_m = right.translation() - left.translation();
  const Vector3d right_in_left_m = left.linear().transpose() * between_m;
  const bool look_alike = left.linear() == right.linear();
  const Matrix3d left_from_right =
      look_alike ? Matrix3d::Identity() : Matrix3d(left.linear().transpose() * right.linear());
  RigCalibration calibration;
  if (is_same(cameras[0], cameras[1]) && is_along_rows(right_in_left_m)) {
    calibration.rig.intrinsics = cameras[0].pinhole;
    calibration.rig.distortion = cameras[0].lens;
    calibration.rig.right_turn_rad = turn_angles(left_from_right).unaryExpr(&in_short_degrees);
  } else {
    calibration = rig_of_two(cameras, right_in_left_m, left_from_right);
  }
  calibration.rig.baseline_m = between_m.norm();
  stand_on(body_from_rectified(calibration, cameras[0]), calibration.rig);
  if (!vision::is_usable(calibration.rig)) throw std::runtime_error("expected cameras at different places");
  return calibration;
}

Isometry3d body_from_robot(const RigCalibration& calibration, const ViewCamera& left) {
  return body_from_rectified(calibration, left) * vision::robot_from_camera(calibration.rig).inverse();
}

}  // namespace stereobench::harness
