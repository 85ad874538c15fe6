/// What a log says of its poses and landmarks, as residuals of unit variance with their derivatives.
#pragma once

#include <Eigen/Core>

#include "slam/models/belief.h"

namespace stereobench::slam {

/// No residual knows a length or an angle better than this.
inline constexpr double kLeast_m = 1e-6;
inline constexpr double kLeast_rad = 1e-7;

/// A step's odometry: how far two poses lie from where it would put them, in standard deviations.
///
/// Motions are compared along and across the direction half way of the turn. There a single control moves
/// along and turns, and whatever its errors are, never moves across: its noise has rank two. What it leaves
/// out is given kAcrossShare of the step's own deviation (chord.h). That is less than a log can tell, and
/// enough for a search to move in all directions.
class MotionResidual {
 public:
  struct Value {
    Eigen::Vector3d residual = Eigen::Vector3d::Zero();
    Eigen::Matrix3d by_from = Eigen::Matrix3d::Zero();  ///< d residual / d(x, y, heading)
    Eigen::Matrix3d by_to = Eigen::Matrix3d::Zero();
  };

  /// @param start_from_end the mean motion over the step and its covariance, of any rank
  explicit MotionResidual(const PoseBelief& start_from_end);

  /// @param from world_from_robot before the step; headings need not be wrapped
  /// @param to after it
  Value at(const Pose& from, const Pose& to) const;

 private:
  Eigen::Vector3d mean_;      ///< along, across, turn
  Eigen::Matrix3d whitener_;  ///< W with W C W' = I
};

/// A sighting: how far it lies from what should have been seen, in standard deviations.
class SightingResidual {
 public:
  struct Value {
    Eigen::Vector2d residual = Eigen::Vector2d::Zero();
    Eigen::Matrix<double, 2, 3> by_pose = Eigen::Matrix<double, 2, 3>::Zero();
    Eigen::Matrix2d by_landmark = Eigen::Matrix2d::Zero();
  };

  explicit SightingResidual(const Observation& observation);

  /// @param robot world_from_robot
  /// @param landmark in the world, m
  Value at(const Pose& robot, const Eigen::Vector2d& landmark) const;

 private:
  Eigen::Vector2d seen_;
  Eigen::Matrix2d whitener_;
};

}  // namespace stereobench::slam
