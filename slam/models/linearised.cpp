#include "slam/models/linearised.h"

#include <cmath>

#include "slam/math/elementary.h"
#include "slam/math/gaussian.h"
#include "slam/models/measurement.h"
#include "slam/models/motion.h"
#include "slam/models/noise_law.h"

namespace stereobench::slam {
PoseBelief Linearised::move(const PoseBelief& belief, const Control& control,
                            const Eigen::Vector2d& control_sd, long&) const {
  const PoseBelief moved{advance(belief.mean, control), belief.covariance};
  const double dt = control.duration_s;
  const double half_turn = 0.5 * control.w_radps * dt;
  const double direction = belief.mean.heading_rad + half_turn;
  const SineCosine heading = sine_cosine(direction);
  const Eigen::Vector2d along(heading.cosine, heading.sine);
  const Eigen::Vector2d across(-along.y(), along.x());
  // chord = v dt sinc(h), h = w dt / 2; d sinc/dh = (cos h - sinc h) / h, about -h/3 for small h.
  const bool small = std::abs(half_turn) < 1e-4;
  const auto [s, c] = sine_cosine(half_turn);
  const double sinc = small ? 1.0 - half_turn * half_turn / 6.0 : s / half_turn;
  const double sinc_slope = small ? -half_turn / 3.0 : (c - sinc) / half_turn;
  Eigen::Matrix3d by_pose = Eigen::Matrix3d::Identity();
  by_pose(0, 2) = -(moved.mean.y_m - belief.mean.y_m);
  by_pose(1, 2) = moved.mean.x_m - belief.mean.x_m;
  Eigen::Matrix<double, 3, 2> by_control = Eigen::Matrix<double, 3, 2>::Zero();
  by_control.block<2, 1>(0, 0) = dt * sinc * along;
  by_control.block<2, 1>(0, 1) = 0.5 * control.v_mps * dt * dt * (sinc_slope * along + sinc * across);
  by_control(2, 1) = dt;
  const Eigen::Matrix<double, 3, 2> spread = by_control * control_sd.asDiagonal();
  const Eigen::Matrix3d covariance =
      by_pose * belief.covariance * by_pose.transpose() + spread * spread.transpose();
  return {moved.mean, 0.5 * (covariance + covariance.transpose())};
}

PredictedMeasurement Linearised::expect(const PoseBelief& belief, const LandmarkBelief& landmark,
                                        const Observation& observation, long&) const {
  const LinearSighting linear = linearise_sighting(belief.mean, landmark.mean);
  const Eigen::Matrix2d& by_landmark = linear.by_landmark;
  const Eigen::Matrix<double, 2, 3> by_pose = linear.by_pose();
  PredictedMeasurement predicted;
  predicted.expected = linear.expected;
  // Products that are not told so go through temporaries of their own.
  predicted.cross.noalias() = belief.covariance * by_pose.transpose();
  predicted.covariance.noalias() = by_pose * predicted.cross;
  Eigen::Matrix2d from_landmark;
  from_landmark.noalias() = by_landmark * landmark.covariance;
  predicted.covariance.noalias() += from_landmark * by_landmark.transpose();
  predicted.covariance += noise_at(observation, predicted.expected);
  return predicted;
}

PredictedMeasurement Linearised::expect(const Pose& robot, const LandmarkBelief& landmark,
                                        const Observation& observation, long&) const {
  const LinearSighting linear = linearise_sighting(robot, landmark.mean);
  PredictedMeasurement predicted;
  predicted.expected = linear.expected;
  Eigen::Matrix2d from_landmark;
  from_landmark.noalias() = linear.by_landmark * landmark.covariance;
  predicted.covariance.noalias() = from_landmark * linear.by_landmark.transpose();
  predicted.covariance += noise_at(observation, predicted.expected);
  return predicted;
}

LandmarkBelief Linearised::refine(const LandmarkBelief& landmark, const Pose& robot,
                                  const Observation& observation, long& repairs) const {
  const auto [expected, slope] = linearise_sighting(robot, landmark.mean);
  Eigen::Matrix2d cross;
  cross.noalias() = landmark.covariance * slope.transpose();
  const Eigen::Matrix2d noise = noise_at(observation, expected);
  const long before = repairs;
  Eigen::Matrix2d seen = noise;
  seen.noalias() += slope * cross;
  const Factor2 factor(seen, repairs);
  if (repairs != before) return landmark;  // neither is uncertain: nothing can be learnt
  const Eigen::Matrix2d gain = factor.divide<2>(cross);
  const Eigen::Vector2d innovation = sighting_residual(observation.range_bearing, expected);
  // Joseph's form stays semidefinite under rounding.
  const Eigen::Matrix2d kept = Eigen::Matrix2d::Identity() - gain * slope;
  const Eigen::Matrix2d covariance =
      kept * landmark.covariance * kept.transpose() + gain * noise * gain.transpose();
  return {landmark.mean + gain * innovation, 0.5 * (covariance + covariance.transpose())};
}

LandmarkBelief Linearised::found(const Pose& robot, const Observation& observation, long&) const {
  const double direction = robot.heading_rad + observation.range_bearing.y();
  const Eigen::Matrix2d noise = noise_at(observation, observation.range_bearing);
  // A range of 0 was noisy too: the bearing's lever is at least the range's own standard deviation.
  const double lever = std::max(observation.range_bearing.x(), std::sqrt(noise(0, 0)));
  const auto [s, c] = sine_cosine(direction);
  Eigen::Matrix2d slope;
  slope << c, -lever * s, s, lever * c;
  const Eigen::Matrix2d covariance = slope * noise * slope.transpose();
  return {locate(robot, observation.range_bearing), 0.5 * (covariance + covariance.transpose())};
}

}  // namespace stereobench::slam
