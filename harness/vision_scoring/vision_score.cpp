#include "harness/vision_scoring/vision_score.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "harness/vision_scoring/detection_outcome.h"
#include "slam/math/elementary.h"
#include "slam/models/motion.h"

namespace stereobench::harness {

namespace {

void add_errors(const BallInPair& ball, const vision::BallObservation& observation, VisionScore& score) {
  const DetectionError error = detection_error(ball, observation);
  score.range_errors_m.push_back(error.range_m);
  score.bearing_errors_rad.push_back(error.bearing_rad);
  if (observation.has_pixels) score.disparity_errors_px.push_back(disparity_error_px(ball, observation));
  if (std::isfinite(error.normalised)) score.normalised_errors.push_back(error.normalised);
}

double sorted_sum(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum;
}

/// Summed in order of size, so that it does not depend on the order in which scores were merged.
double mean(const std::vector<double>& values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  return sorted_sum(values) / static_cast<double>(values.size());
}

double rms(const std::vector<double>& errors) {
  std::vector<double> squares;
  for (const double error : errors) squares.push_back(error * error);
  return std::sqrt(mean(squares));
}

double ratio(long part, long whole) {
  if (whole == 0) return std::numeric_limits<double>::quiet_NaN();
  return static_cast<double>(part) / static_cast<double>(whole);
}

void append(std::vector<double>& values, const std::vector<double>& more) {
  values.insert(values.end(), more.begin(), more.end());
}

}  // namespace

double VisionScore::recall() const {
  return ratio(found, visible);
}
double VisionScore::precision() const {
  return ratio(right, observations);
}
double VisionScore::range_rms_m() const {
  return rms(range_errors_m);
}
double VisionScore::bearing_rms_rad() const {
  return rms(bearing_errors_rad);
}
double VisionScore::disparity_rms_px() const {
  return rms(disparity_errors_px);
}
double VisionScore::range_bias_m() const {
  return mean(range_errors_m);
}
double VisionScore::bearing_bias_rad() const {
  return mean(bearing_errors_rad);
}
double VisionScore::disparity_bias_px() const {
  return mean(disparity_errors_px);
}
double VisionScore::mean_normalised_error() const {
  return mean(normalised_errors);
}

VisionScore& VisionScore::operator+=(const VisionScore& other) {
  visible += other.visible;
  found += other.found;
  observations += other.observations;
  right += other.right;
  misidentified += other.misidentified;
  spurious += other.spurious;
  repeated += other.repeated;
  flagged += other.flagged;
  append(range_errors_m, other.range_errors_m);
  append(bearing_errors_rad, other.bearing_errors_rad);
  append(disparity_errors_px, other.disparity_errors_px);
  append(normalised_errors, other.normalised_errors);
  rig += other.rig;
  return *this;
}

DetectionError detection_error(const BallInPair& ball, const vision::BallObservation& undistorted) {
  const Eigen::Vector2d true_position = ball.ball_in_robot.head<2>();
  const slam::RangeBearing& measured = undistorted.range_bearing;
  const double true_bearing_rad = slam::arc_tangent(true_position.y(), true_position.x());
  const Eigen::Vector2d error(measured.range_m - true_position.norm(),
                              slam::wrap_angle(measured.bearing_rad - true_bearing_rad));
  return {error.x(), error.y(), error.dot(measured.covariance.inverse() * error) / 2.0};
}

double disparity_error_px(const BallInPair& ball, const vision::BallObservation& undistorted) {
  if (!undistorted.has_pixels) return std::numeric_limits<double>::quiet_NaN();
  return undistorted.left_px.x() - undistorted.right_px.x() -
         (ball.left.centre_px.x() - ball.right.centre_px.x());
}

VisionScore score_match(const FrameMatch& match) {
  const PairOutcome pair = judge_detections(match);
  const auto count_of = [&pair](DetectionOutcome outcome) {
    return static_cast<long>(std::ranges::count(pair.detections, outcome));
  };
  VisionScore score;
  score.right = count_of(DetectionOutcome::kTruePositive);
  score.misidentified = count_of(DetectionOutcome::kWrongIdentity);
  score.repeated = count_of(DetectionOutcome::kDuplicate);
  score.spurious = count_of(DetectionOutcome::kFalsePositive);
  score.flagged = count_of(DetectionOutcome::kFlagged);
  score.observations = static_cast<long>(pair.detections.size()) - score.flagged;
  for (std::size_t i = 0; i < pair.detections.size(); ++i) {
    const MatchedObservation& seen = match.observations[i];
    if (pair.detections[i] == DetectionOutcome::kTruePositive)
      add_errors(match.outlines[*seen.outline], seen.undistorted, score);
  }
  for (std::size_t i = 0; i < match.outlines.size(); ++i) {
    if (!pair.is_required[i]) continue;
    ++score.visible;
    score.found += pair.is_found[i] ? 1 : 0;
  }
  return score;
}

}  // namespace stereobench::harness
