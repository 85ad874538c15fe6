#include "slam/reference/residuals.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "slam/math/elementary.h"
#include "slam/models/measurement.h"
#include "slam/models/motion.h"

namespace stereobench::slam {
namespace {

constexpr double kMissingShare = 0.01;  ///< of the step's deviation, where a control's noise has none

/// The motion between two poses that turns by `turn_rad`, along and across the direction half way of the
/// turn.
Eigen::Vector3d chord(const Pose& from, const Pose& to, double turn_rad) {
  const double direction_rad = from.heading_rad + 0.5 * turn_rad;
  const auto [s, c] = sine_cosine(direction_rad);
  const double dx = to.x_m - from.x_m;
  const double dy = to.y_m - from.y_m;
  return {c * dx + s * dy, c * dy - s * dx, turn_rad};
}

/// d chord / d(x, y, heading) of the pose at its end; that of its start differs in signs.
Eigen::Matrix3d chord_by_end(double direction_rad, const Eigen::Vector3d& motion) {
  const auto [s, c] = sine_cosine(direction_rad);
  Eigen::Matrix3d slope;
  slope << c, s, 0.5 * motion.y(), -s, c, -0.5 * motion.x(), 0.0, 0.0, 1.0;
  return slope;
}

/// W with W C W' = I.
template <int kSize>
Eigen::Matrix<double, kSize, kSize> whitener(const Eigen::Matrix<double, kSize, kSize>& covariance) {
  const Eigen::LLT<Eigen::Matrix<double, kSize, kSize>> factor(covariance);
  return factor.matrixL().solve(Eigen::Matrix<double, kSize, kSize>::Identity());
}

}  // namespace

MotionResidual::MotionResidual(const PoseBelief& start_from_end) {
  const Pose& end = start_from_end.mean;
  mean_ = chord({}, end, end.heading_rad);
  const Eigen::Matrix3d slope = chord_by_end(0.5 * end.heading_rad, mean_);
  Eigen::Matrix3d covariance = slope * start_from_end.covariance * slope.transpose();
  const double missing_m2 =
      kMissingShare * kMissingShare * (covariance(0, 0) + covariance(1, 1)) + kLeast_m * kLeast_m;
  covariance.diagonal() += Eigen::Vector3d(missing_m2, missing_m2, kLeast_rad * kLeast_rad);
  whitener_ = whitener<3>(covariance);
}

MotionResidual::Value MotionResidual::at(const Pose& from, const Pose& to) const {
  const double turn_rad = mean_.z() + wrap_angle(to.heading_rad - from.heading_rad - mean_.z());
  const Eigen::Vector3d motion = chord(from, to, turn_rad);
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
