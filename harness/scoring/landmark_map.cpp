#include "harness/scoring/landmark_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "harness/scoring/trajectory.h"
#include "slam/math/elementary.h"

namespace stereobench::harness {

namespace {

Eigen::Vector2d moved(const slam::Pose& target_from_source, const Eigen::Vector2d& point) {
  const auto [s, c] = slam::sine_cosine(target_from_source.heading_rad);
  return {target_from_source.x_m + c * point.x() - s * point.y(),
          target_from_source.y_m + s * point.x() + c * point.y()};
}

}  // namespace

std::optional<std::size_t> owner(const slam::LandmarkEstimate& estimate, const Eigen::Vector2d& position_m,
                                 std::span<const LandmarkTruth> truth, double match_limit_m) {
  std::optional<std::size_t> nearest;
  double nearest_m = match_limit_m;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (estimate.landmark_id != slam::kUnknown) {
      if (estimate.landmark_id == truth[i].landmark_id) return i;
      continue;
    }
    const double distance_m = (truth[i].position_m - position_m).norm();
    const bool alike =
        estimate.colour_class == slam::kUnknown || estimate.colour_class == truth[i].colour_class;
    if (alike && distance_m <= nearest_m) {
      nearest = i;
      nearest_m = distance_m;
    }
  }
  return nearest;
}

slam::Pose align_map(std::span<const slam::LandmarkEstimate> estimates, std::span<const LandmarkTruth> truth,
                     const slam::Pose& truth_from_estimate, double match_limit_m) {
  std::vector<PosePair> pairs;
  for (const slam::LandmarkEstimate& estimate : estimates) {
    const Eigen::Vector2d position_m = moved(truth_from_estimate, estimate.position_m);
    const auto index = owner(estimate, position_m, truth, match_limit_m);
    if (!index) continue;
    const Eigen::Vector2d& place_m = truth[*index].position_m;
    pairs.push_back(
        {{estimate.position_m.x(), estimate.position_m.y(), 0.0}, {place_m.x(), place_m.y(), 0.0}});
  }
  return align(pairs);
}

slam::LandmarkEstimate moved_landmark(const slam::Pose& target_from_source,
                                      const slam::LandmarkEstimate& landmark) {
  const auto [s, c] = slam::sine_cosine(target_from_source.heading_rad);
  Eigen::Matrix2d turn;
  turn << c, -s, s, c;
  slam::LandmarkEstimate there = landmark;
  there.position_m = moved(target_from_source, landmark.position_m);
  there.covariance = turn * landmark.covariance * turn.transpose();
  return there;
}

MapScore unknown_map_score() {
  constexpr double kNoError = std::numeric_limits<double>::quiet_NaN();
  return {.rms_m = kNoError, .max_m = kNoError};
}

MapScore score_map(std::span<const slam::LandmarkEstimate> estimates, std::span<const LandmarkTruth> truth,
                   const slam::Pose& truth_from_estimate, double match_limit_m) {
  MapScore score;
  std::vector<long> owned(truth.size(), 0);
  double squares = 0.0;
  for (const slam::LandmarkEstimate& estimate : estimates) {
    const Eigen::Vector2d position_m = moved(truth_from_estimate, estimate.position_m);
    const auto index = owner(estimate, position_m, truth, match_limit_m);
    if (!index) {
      ++score.spurious;
      continue;
    }
    ++owned[*index];
    const double error_m = (position_m - truth[*index].position_m).norm();
    squares += error_m * error_m;
    score.max_m = std::max(score.max_m, error_m);
  }
  score.found_once = std::count(owned.begin(), owned.end(), 1);
  score.missed = std::count(owned.begin(), owned.end(), 0);
  score.duplicated = static_cast<long>(owned.size()) - score.found_once - score.missed;
  const long matched = static_cast<long>(estimates.size()) - score.spurious;
  const double none = std::numeric_limits<double>::quiet_NaN();
  score.rms_m = matched > 0 ? std::sqrt(squares / static_cast<double>(matched)) : none;
  if (matched == 0) score.max_m = none;
  return score;
}

}  // namespace stereobench::harness
