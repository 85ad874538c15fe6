#include "harness/vision_scoring/vision_score.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/LU>

#include "slam/math/elementary.h"
#include "slam/models/motion.h"
#include "vision/camera/rig.h"

namespace stereobench::harness {

namespace {

constexpr double kSmallestRadius_px = 5.0;

/// A ball has to be found when it is whole, not tiny and hardly hidden.
bool must_be_found(const BallOutline& ball) {
  return is_whole(ball) && std::min(ball.left.radius_px(), ball.right.radius_px()) >= kSmallestRadius_px;
}

/// Whether an observation claims no other colour than the ball has.
bool suits_colour(const VisionTruth& truth, const BallOutline& ball,
                  const vision::BallObservation& observation) {
  return observation.colour == slam::kUnknown ||
         observation.colour == truth.world.balls[static_cast<std::size_t>(ball.ball)].colour;
}

/// Whether an observation is within a ball's outline in both eyes. Where it says nothing of heights it is
/// taken to be at the ball's.
bool is_on(const VisionTruth& truth, const BallOutline& ball, const vision::BallObservation& observation) {
  if (observation.has_pixels)
    return contains(ball.left, observation.left_px) && contains(ball.right, observation.right_px);
  const slam::RangeBearing& seen = observation.range_bearing;
  const auto [s, c] = slam::sine_cosine(seen.bearing_rad);
  const Eigen::Vector3d in_robot(seen.range_m * c, seen.range_m * s, ball.ball_in_robot.z());
  const Eigen::Vector3d in_left = vision::robot_from_camera(truth.rig).inverse() * in_robot;
  const Eigen::Vector3d in_right = vision::point_in_eye(truth.rig, in_left, vision::Eye::kRight);
  return in_left.z() > 0.0 && in_right.z() > 0.0 &&
         contains(ball.left, vision::project(truth.rig.camera, in_left)) &&
         contains(ball.right, vision::project(truth.rig.camera, in_right));
}

/// The ball under an observation: one whose colour suits it if there is one, else any that is not wholly
/// hidden; where no pixels tell balls of one direction apart, the one whose range is nearest.
std::optional<std::size_t> ball_under(const VisionTruth& truth, const std::vector<BallOutline>& balls,
                                      const vision::BallObservation& observation) {
  std::optional<std::size_t> under;
  std::pair<bool, double> least;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const BallOutline& ball = balls[i];
    const bool hidden = ball.left_fraction <= 0.0 || ball.right_fraction <= 0.0;
    if (hidden || !is_on(truth, ball, observation)) continue;
    const double range_gap_m =
        std::abs(observation.range_bearing.range_m - ball.ball_in_robot.head<2>().norm());
    const std::pair<bool, double> misfit(!suits_colour(truth, ball, observation),
                                         observation.has_pixels ? 0.0 : range_gap_m);
    if (under && misfit >= least) continue;
    under = i;
    least = misfit;
  }
  return under;
}

void add_errors(const BallOutline& ball, const vision::BallObservation& observation, VisionScore& score) {
  const Eigen::Vector2d true_position = ball.ball_in_robot.head<2>();
  const slam::RangeBearing& measured = observation.range_bearing;
  const double true_bearing_rad = slam::arc_tangent(true_position.y(), true_position.x());
  const Eigen::Vector2d error(measured.range_m - true_position.norm(),
                              slam::wrap_angle(measured.bearing_rad - true_bearing_rad));
  score.range_errors_m.push_back(error.x());
  score.bearing_errors_rad.push_back(error.y());
  if (observation.has_pixels) score.disparity_errors_px.push_back(disparity_error_px(ball, observation));
  const double squared = error.dot(measured.covariance.inverse() * error);
  if (std::isfinite(squared)) score.normalised_errors.push_back(squared / 2.0);
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

std::vector<vision::BallObservation> straightened(const vision::StereoRig& rig,
                                                  std::span<const vision::BallObservation> observations) {
  const Eigen::Vector2d nowhere = Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  std::vector<vision::BallObservation> straight(observations.begin(), observations.end());
  for (vision::BallObservation& observation : straight) {
    observation.left_px = vision::pinhole_point(rig, observation.left_px).value_or(nowhere);
    observation.right_px = vision::pinhole_point(rig, observation.right_px).value_or(nowhere);
  }
  return straight;
}

double disparity_error_px(const BallOutline& ball, const vision::BallObservation& straight) {
  if (!straight.has_pixels) return std::numeric_limits<double>::quiet_NaN();
  return straight.left_px.x() - straight.right_px.x() - (ball.left.centre_px.x() - ball.right.centre_px.x());
}

VisionScore score_observations(const VisionTruth& truth,
                               std::span<const vision::BallObservation> observations) {
  const std::vector<BallOutline> balls = ball_outlines(truth);
  std::vector<bool> found(balls.size(), false);
  VisionScore score;
  for (const vision::BallObservation& observation : straightened(truth.rig, observations)) {
    if (!observation.trusted()) {
      ++score.flagged;
      continue;
    }
    ++score.observations;
    const auto under = ball_under(truth, balls, observation);
    if (!under) {
      ++score.spurious;
    } else if (!suits_colour(truth, balls[*under], observation)) {
      ++score.misidentified;
    } else if (found[*under]) {
      ++score.repeated;
    } else {
      found[*under] = true;
      ++score.right;
      add_errors(balls[*under], observation, score);
    }
  }
  for (std::size_t i = 0; i < balls.size(); ++i) {
    if (!must_be_found(balls[i])) continue;
    ++score.visible;
    score.found += found[i] ? 1 : 0;
  }
  return score;
}

std::vector<int> balls_observed(const VisionTruth& truth,
                                std::span<const vision::BallObservation> observations) {
  const std::vector<BallOutline> balls = ball_outlines(truth);
  std::vector<int> observed;
  for (const vision::BallObservation& observation : straightened(truth.rig, observations)) {
    const auto under = ball_under(truth, balls, observation);
    observed.push_back(under ? balls[*under].ball : slam::kUnknown);
  }
  return observed;
}

}  // namespace stereobench::harness
