/// What a start pose that is known badly makes of a belief that takes it for exact.
#pragma once

#include <Eigen/Core>

#include "slam/types.h"

namespace stereobench::slam {

/// A start pose that may be off.
///
/// Motion and sightings are relative: wherever a robot starts, it measures the same. Whatever is estimated
/// from an exact start then holds in the frame of the start, and another start turns and shifts all of it.
/// The mean squared errors below are exact for a Gaussian start, however large its heading's error is; to
/// first order a place d away would be off by d times that error across, and not at all along.
class UncertainStart {
 public:
  /// @param mean world_from_robot
  /// @param covariance of (x, y, heading), in the world
  UncertainStart(const Pose& mean, const Eigen::Matrix3d& covariance);

  /// @param place in the world, as it is estimated from the mean
  /// @param known its covariance where the start is exact
  /// @return its mean squared error, m^2
  Eigen::Matrix2d of_place(const Eigen::Vector2d& place, const Eigen::Matrix2d& known) const;

  /// The same of a pose (x, y, heading).
  Eigen::Matrix3d of_pose(const Pose& pose, const Eigen::Matrix3d& known) const;

 private:
  Pose mean_;
  Eigen::Matrix3d covariance_;
  bool is_exact_;
  // Of the error a of the start's heading:
  double cosine_;        ///< E cos a = exp(-variance / 2); E sin a is 0
  double cosine_twice_;  ///< E cos 2a
  double shrinking_;     ///< E (1 - cos a)^2
  double swinging_;      ///< E sin^2 a
  double with_sine_;     ///< E a sin a
};

}  // namespace stereobench::slam
