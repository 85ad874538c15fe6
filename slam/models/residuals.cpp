#include "slam/models/residuals.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "slam/models/chord.h"
#include "slam/models/measurement.h"
#include "slam/models/motion.h"

namespace stereobench::slam {
namespace {

/// W with W C W' = I.
template <int kSize>
Eigen::Matrix<double, kSize, kSize> whitener(const Eigen::Matrix<double, kSize, kSize>& covariance) {
  const Eigen::LLT<Eigen::Matrix<double, kSize, kSize>> factor(covariance);
  return factor.matrixL().solve(Eigen::Matrix<double, kSize, kSize>::Identity());
}

}  // namespace

MotionResidual::MotionResidual(const PoseBelief& start_from_end) {
  auto [mean, covariance] = chord_of(start_from_end);
  mean_ = mean;
  const double missing_m2 =
      kAcrossShare * kAcrossShare * (covariance(0, 0) + covariance(1, 1)) + kLeast_m * kLeast_m;
  covariance.diagonal() += Eigen::Vector3d(missing_m2, missing_m2, kLeast_rad * kLeast_rad);
  whitener_ = whitener<3>(covariance);
}

MotionResidual::Value MotionResidual::at(const Pose& from, const Pose& to) const {
  const double turn_rad = mean_.z() + wrap_angle(to.heading_rad - from.heading_rad - mean_.z());
  const Eigen::Vector3d motion = chord_between(from, to, turn_rad);
  const Eigen::Matrix3d by_to = chord_by_end(from.heading_rad + 0.5 * turn_rad, motion);
  Eigen::Matrix3d by_from = -by_to;
  by_from.block<2, 1>(0, 2) = by_to.block<2, 1>(0, 2);  // both turn the middle by half
  return {whitener_ * (motion - mean_), whitener_ * by_from, whitener_ * by_to};
}

SightingResidual::SightingResidual(const Observation& observation) : seen_(observation.range_bearing) {
  Eigen::Matrix2d covariance = observation.noise;
  covariance.diagonal() += Eigen::Vector2d(kLeast_m, kLeast_rad).cwiseAbs2();
  whitener_ = whitener<2>(covariance);
}

SightingResidual::Value SightingResidual::at(const Pose& robot, const Eigen::Vector2d& landmark) const {
  const LinearSighting linear = linearise_sighting(robot, landmark);
  return {whitener_ * sighting_residual(linear.expected, seen_), whitener_ * linear.by_pose(),
          whitener_ * linear.by_landmark};
}

}  // namespace stereobench::slam
