#include "vision/stereo/range_bearing.h"

#include <cmath>

#include "slam/math/elementary.h"
#include "vision/camera/rig.h"
#include "vision/stereo/sphere.h"

namespace stereobench::vision {
namespace {

// Derivative of triangulate_ball by (u_left, v_left, u_right, v_right).
Eigen::Matrix<double, 3, 4> ball_by_pixels(const StereoRig& rig, const OutlineCentres& centres,
                                           double radius_m) {
  const double disparity = centres.left_px.x() - centres.right_px.x();
  const double zn = rig.intrinsics.focal_px * rig.baseline_m / disparity;
  const double zn_by_disparity = -zn / disparity;
  const double z_by_zn = 0.5 * (1.0 + zn / std::sqrt(zn * zn + 4.0 * radius_m * radius_m));
  const Eigen::Vector2d pixel(centres.left_px.x(), 0.5 * (centres.left_px.y() + centres.right_px.y()));
  const Eigen::Vector3d ray = pixel_ray(rig.intrinsics, pixel);

  const Eigen::Vector3d by_disparity(ray.x() * zn_by_disparity, ray.y() * zn_by_disparity,
                                     z_by_zn * zn_by_disparity);
  Eigen::Matrix<double, 3, 4> jacobian = Eigen::Matrix<double, 3, 4>::Zero();
  jacobian.col(0) = by_disparity;
  jacobian.col(2) = -by_disparity;
  jacobian(0, 0) += zn / rig.intrinsics.focal_px;
  jacobian(1, 1) = 0.5 * zn / rig.intrinsics.focal_px;
  jacobian(1, 3) = jacobian(1, 1);
  return jacobian;
}

}  // namespace

Eigen::Matrix3d ball_covariance(const StereoRig& rig, const OutlineCentres& centres, double radius_m) {
  Eigen::Matrix4d pixels = Eigen::Matrix4d::Zero();
  pixels.topLeftCorner<2, 2>() = centres.left_covariance_px2;
  pixels.bottomRightCorner<2, 2>() = centres.right_covariance_px2;
  const Eigen::Matrix<double, 3, 4> jacobian = ball_by_pixels(rig, centres, radius_m);
  const Eigen::Matrix3d covariance = jacobian * pixels * jacobian.transpose();
  return 0.5 * (covariance + covariance.transpose());
}

slam::RangeBearing range_bearing(const Eigen::Vector3d& point_in_camera, const Eigen::Matrix3d& covariance_m2,
                                 const Eigen::Isometry3d& frame_from_camera) {
  const Eigen::Vector3d point = frame_from_camera * point_in_camera;
  const double range = point.head<2>().norm();
  Eigen::Matrix<double, 2, 3> by_point = Eigen::Matrix<double, 2, 3>::Zero();
  by_point(0, 0) = point.x() / range;
  by_point(0, 1) = point.y() / range;
  by_point(1, 0) = -point.y() / (range * range);
  by_point(1, 1) = point.x() / (range * range);
  const Eigen::Matrix<double, 2, 3> jacobian = by_point * frame_from_camera.linear();

  slam::RangeBearing result;
  result.range_m = range;
  result.bearing_rad = slam::arc_tangent(point.y(), point.x());
  const Eigen::Matrix2d covariance = jacobian * covariance_m2 * jacobian.transpose();
  result.covariance = 0.5 * (covariance + covariance.transpose());
  return result;
}

}  // namespace stereobench::vision
