#include "harness/scoring/trajectory.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "slam/math/elementary.h"
#include "slam/models/motion.h"

namespace stereobench::harness {

namespace {

constexpr double kNoError = std::numeric_limits<double>::quiet_NaN();

Eigen::Vector2d position(const slam::Pose& pose) {
  return {pose.x_m, pose.y_m};
}

/// Root mean square and largest of what is added to it.
class ErrorSum {
 public:
  void add(double error) {
    squares_ += error * error;
    largest_ = std::max(largest_, std::abs(error));
    ++count_;
  }
  double rms() const { return count_ > 0 ? std::sqrt(squares_ / static_cast<double>(count_)) : kNoError; }
  double max() const { return count_ > 0 ? largest_ : kNoError; }

 private:
  double squares_ = 0.0;
  double largest_ = 0.0;
  long count_ = 0;
};

ErrorSum position_errors(std::span<const PosePair> pairs, const slam::Pose& truth_from_estimate) {
  ErrorSum errors;
  for (const PosePair& pair : pairs) {
    const slam::Pose aligned = slam::compose(truth_from_estimate, pair.estimate);
    errors.add((position(aligned) - position(pair.truth)).norm());
  }
  return errors;
}

/// What an estimated motion between two instants lacks to the true one (Sturm et al., IROS 2012).
slam::Pose relative_error(const PosePair& from, const PosePair& to) {
  const slam::Pose true_motion = slam::compose(slam::inverse(from.truth), to.truth);
  const slam::Pose estimated_motion = slam::compose(slam::inverse(from.estimate), to.estimate);
  return slam::compose(slam::inverse(true_motion), estimated_motion);
}

double length_m(std::span<const PosePair> pairs) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    length_m += (position(pairs[i].truth) - position(pairs[i - 1].truth)).norm();
  }
  return length_m;
}

}  // namespace

std::vector<PosePair> pair_with_truth(std::span<const slam::Pose> poses, const MeasurementLog& log) {
  if (poses.size() != log.steps.size()) {
    throw std::invalid_argument("pair_with_truth: expected one pose for each step of the log");
  }
  std::vector<PosePair> pairs;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (log.steps[i].truth) pairs.push_back({poses[i], *log.steps[i].truth});
  }
  return pairs;
}

slam::Pose align(std::span<const PosePair> pairs) {
  if (pairs.empty()) return {};
  Eigen::Vector2d estimate_mean = Eigen::Vector2d::Zero();
  Eigen::Vector2d truth_mean = Eigen::Vector2d::Zero();
  for (const PosePair& pair : pairs) {
    estimate_mean += position(pair.estimate);
    truth_mean += position(pair.truth);
  }
  estimate_mean /= static_cast<double>(pairs.size());
  truth_mean /= static_cast<double>(pairs.size());
  double cosine = 0.0;  // sums of dot and cross products: the angle's cosine and sine up to a factor
  double sine = 0.0;
  for (const PosePair& pair : pairs) {
    const Eigen::Vector2d a = position(pair.estimate) - estimate_mean;
    const Eigen::Vector2d b = position(pair.truth) - truth_mean;
    cosine += a.dot(b);
    sine += a.x() * b.y() - a.y() * b.x();
  }
  const double heading_rad = slam::arc_tangent(sine, cosine);
  const slam::Pose turn{0.0, 0.0, heading_rad};
  const slam::Pose turned = slam::compose(turn, {estimate_mean.x(), estimate_mean.y(), 0.0});
  return {truth_mean.x() - turned.x_m, truth_mean.y() - turned.y_m, heading_rad};
}

TrajectoryScore score_trajectory(std::span<const PosePair> pairs, int rpe_steps) {
  if (rpe_steps < 1) throw std::invalid_argument("score_trajectory: a relative error spans at least a step");
  TrajectoryScore score;
  score.scored_steps = static_cast<long>(pairs.size());
  score.truth_from_estimate = align(pairs);
  const ErrorSum raw = position_errors(pairs, {});
  const ErrorSum aligned = position_errors(pairs, score.truth_from_estimate);
  ErrorSum heading;
  for (const PosePair& pair : pairs) {
    heading.add(slam::wrap_angle(pair.estimate.heading_rad - pair.truth.heading_rad));
  }
  ErrorSum relative;
  ErrorSum relative_heading;
  const std::size_t span = static_cast<std::size_t>(rpe_steps);
  for (std::size_t i = span; i < pairs.size(); ++i) {
    const slam::Pose error = relative_error(pairs[i - span], pairs[i]);
    relative.add(position(error).norm());
    relative_heading.add(error.heading_rad);
  }
  score.ate_rms_m = raw.rms();
  score.ate_max_m = raw.max();
  score.ate_aligned_rms_m = aligned.rms();
  score.ate_aligned_max_m = aligned.max();
  score.heading_rms_rad = heading.rms();
  score.rpe_rms_m = relative.rms();
  score.rpe_heading_rms_rad = relative_heading.rms();
  const double driven_m = length_m(pairs);
  score.final_drift = driven_m > 0.0
                          ? (position(pairs.back().estimate) - position(pairs.back().truth)).norm() / driven_m
                          : kNoError;
  return score;
}

}  // namespace stereobench::harness
