#include "slam/ekf/joint_belief.h"

#include <cmath>
#include <type_traits>

#include "slam/models/measurement.h"
#include "slam/models/noise_law.h"

namespace stereobench::slam {
namespace {

/// Of a sighting by (pose, landmark).
Eigen::Matrix<double, 2, 5> slope_of(const LinearSighting& linear) {
  Eigen::Matrix<double, 2, 5> slope;
  slope.leftCols<3>() = linear.by_pose();
  slope.rightCols<2>() = linear.by_landmark;
  return slope;
}

/// A sighting against what is expected of it, by slopes that say how that depends on (pose, landmark).
JointInnovation against(const JointBelief& belief, int landmark, const Eigen::Matrix<double, 2, 5>& slope,
                        const Eigen::Vector2d& expected, const Observation& observation, long& repairs) {
  Eigen::Matrix<double, 2, 5> near;
  near.noalias() = slope * belief.covariance.pose_and_landmark(landmark);
  const Eigen::Matrix2d noise = noise_at(observation, expected);
  Eigen::Matrix2d covariance;
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) covariance(i, j) = near.row(i).dot(slope.row(j)) + noise(i, j);
  }
  return {slope, near, covariance, Factor2(covariance, repairs),
          sighting_residual(observation.range_bearing, expected)};
}

/// The Kalman update by the covariances of all with what is seen.
void correct(JointBelief& belief, JointCovariance::Columns& with_seen, const Factor2& factor,
             const Eigen::Vector2d& off, long& repairs) {
  JointCovariance::Columns& whitened = with_seen;
  factor.whiten_in_place(whitened);
  const Eigen::Vector2d residual = factor.whiten<1>(off.transpose()).transpose();
  if (!std::isfinite(whitened.squaredNorm() * residual.squaredNorm())) {
    ++repairs;
    return;
  }
  const auto shift = [&]<int kRows>(Eigen::Index row, std::integral_constant<int, kRows>) {
    return whitened.col(0).segment<kRows>(row) * residual.x() +
           whitened.col(1).segment<kRows>(row) * residual.y();
  };
  belief.pose = boxplus(belief.pose, shift(0, std::integral_constant<int, 3>()));
  for (std::size_t j = 0; j < belief.landmarks.size(); ++j)
    belief.landmarks[j] +=
        shift(JointCovariance::row_of(static_cast<int>(j)), std::integral_constant<int, 2>());
  belief.covariance.subtract(whitened, repairs);
}

}  // namespace

void follow(JointBelief& belief, const PoseBelief& motion) {
  const PoseBelief moved = follow(belief.pose, motion);
  belief.covariance.move_pose(heading_lever(belief.pose, {moved.mean.x_m, moved.mean.y_m}), moved.covariance);
  belief.pose = moved.mean;
}

JointInnovation innovation(const JointBelief& belief, int landmark, const Observation& observation,
                           long& repairs) {
  const LinearSighting linear =
      linearise_sighting(belief.pose, belief.landmarks[static_cast<std::size_t>(landmark)]);
  return against(belief, landmark, slope_of(linear), linear.expected, observation, repairs);
}

JointInnovation innovation(const JointBelief& belief, const JointBelief& at, int landmark,
                           const Observation& observation, long& repairs) {
  const auto j = static_cast<std::size_t>(landmark);
  const LinearSighting linear = linearise_sighting(at.pose, at.landmarks[j]);
  const Eigen::Matrix<double, 2, 5> slope = slope_of(linear);
  Eigen::Matrix<double, 5, 1> off;
  off.head<3>() = boxminus(belief.pose, at.pose);
  off.tail<2>() = belief.landmarks[j] - at.landmarks[j];
  return against(belief, landmark, slope, linear.expected + slope * off, observation, repairs);
}

JointInnovation innovation_at_sighting(const JointBelief& belief, int landmark,
                                       const Observation& observation, long& repairs) {
  const Eigen::Vector2d place = locate(belief.pose, observation.range_bearing);
  const LinearSighting linear = linearise_sighting(belief.pose, place);
  const Eigen::Vector2d off = belief.landmarks[static_cast<std::size_t>(landmark)] - place;
  const Eigen::Matrix<double, 2, 5> slope = slope_of(linear);
  const Eigen::Vector2d expected = linear.expected + slope.rightCols<2>() * off;
  return against(belief, landmark, slope, expected, observation, repairs);
}

ExpectedSighting expectation(const JointInnovation& seen, const Observation& observation,
                             double squared_length) {
  return {true, observation.range_bearing - seen.residual, seen.covariance,
          -0.5 * (squared_length + seen.factor.log_det_2_pi())};
}

void correct(JointBelief& belief, int landmark, const JointInnovation& seen, long& repairs) {
  JointCovariance::Columns with_seen;
  belief.covariance.with_sighting(landmark, seen.slope, seen.near, with_seen);
  correct(belief, with_seen, seen.factor, seen.residual, repairs);
}

Pairing apart(const JointBelief& belief, int one, int other) {
  const auto place = [&](int j) -> const Eigen::Vector2d& {
    return belief.landmarks[static_cast<std::size_t>(j)];
  };
  const Eigen::Matrix2d shared = belief.covariance.between(one, other).bottomRightCorner<2, 2>();
  return {place(one) - place(other),
          belief.covariance.landmark(one) + belief.covariance.landmark(other) - shared - shared.transpose()};
}

void merge(JointBelief& belief, int one, int other, long& repairs) {
  const Pairing off = apart(belief, one, other);
  JointCovariance::Columns with_way;
  belief.covariance.with_difference(one, other, with_way);
  correct(belief, with_way, Factor2(off.covariance, repairs), off.residual, repairs);
}

void place(JointBelief& belief, int landmark, const LandmarkBelief& found, long& repairs) {
  const auto j = static_cast<std::size_t>(landmark);
  if (j == belief.landmarks.size()) belief.landmarks.emplace_back();
  belief.landmarks[j] = found.mean;
  belief.covariance.place(landmark, lever(belief.pose, found.mean), found.covariance, repairs);
}

}  // namespace stereobench::slam
