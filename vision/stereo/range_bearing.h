/// From measured outlines to range and bearing, with the covariance that pixel noise gives them.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "vision/types.h"

namespace stereobench::vision {

/// Where both cameras measured a ball's outline; their errors are independent of each other.
struct OutlineCentres {
  Eigen::Vector2d left_px = Eigen::Vector2d::Zero();  ///< centres of the outlines' ellipses
  Eigen::Vector2d right_px = Eigen::Vector2d::Zero();
  Eigen::Matrix2d left_covariance_px2 = Eigen::Matrix2d::Zero();  ///< of (u, v)
  Eigen::Matrix2d right_covariance_px2 = Eigen::Matrix2d::Zero();
};

/// How pixel errors move the triangulated ball: the covariance of triangulate_ball's result, to first order.
/// @param centres with a positive disparity
/// @return covariance of (X, Y, Z) in the left camera's frame, m^2, symmetric positive semidefinite
Eigen::Matrix3d ball_covariance(const StereoRig& rig, const OutlineCentres& centres, double radius_m);

/// Horizontal range and left-positive bearing of a point, seen from the origin of a frame whose x points
/// forward, y left and z up. The whole covariance is transformed: range and bearing errors are correlated in
/// general (0.71 from the left camera), and happen not to be from the middle of the baseline.
/// @param point_in_camera not straight above or below the frame's origin
/// @param covariance_m2 of the point in the camera frame
/// @param frame_from_camera usually robot_from_camera(rig)
/// @return with the covariance of (range, bearing); no identity and no colour is set
slam::RangeBearing range_bearing(const Eigen::Vector3d& point_in_camera, const Eigen::Matrix3d& covariance_m2,
                                 const Eigen::Isometry3d& frame_from_camera);

}  // namespace stereobench::vision
