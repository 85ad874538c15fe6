#include "harness/scoring/replay.h"

#include <cmath>
#include <filesystem>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "harness/logs/measurement_log_reader.h"
#include "harness/scoring/score.h"
#include "slam/models/motion.h"
#include "tests/harness/scoring/summarise.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

/// A lap of exact odometry around exactly measured landmarks.
MeasurementLog exact_log() {
  MeasurementLog log;
  for (int i = 0; i < 4; ++i) {
    log.landmarks.push_back({i, i, {3.0 * std::cos(1.5 * i), 2.0 + 3.0 * std::sin(1.5 * i)}});
  }
  slam::Pose pose{0.5, 0.0, 0.2};
  log.start = pose;
  for (int i = 0; i < 60; ++i) {
    LogStep step;
    step.stamp_ns = i * 1'000'000'000LL;
    if (i > 0) step.odometry = {{0.2, 0.1, 0.5}, {0.25, 0.11, 0.5}};
    for (const slam::Control& control : step.odometry) pose = slam::advance(pose, control);
    for (const LandmarkTruth& landmark : log.landmarks) {
      const Eigen::Vector2d offset = landmark.position_m - Eigen::Vector2d(pose.x_m, pose.y_m);
      slam::RangeBearing z;
      z.range_m = offset.norm();
      z.bearing_rad = slam::wrap_angle(std::atan2(offset.y(), offset.x()) - pose.heading_rad);
      z.covariance = Eigen::Vector2d(1e-4, 1e-4).asDiagonal();
      z.landmark_id = landmark.landmark_id;
      step.measurements.push_back(z);
    }
    step.truth = pose;
    log.steps.push_back(step);
  }
  return log;
}

slam::FilterConfig noisy_config() {
  slam::FilterConfig config;
  config.particles = 5;
  config.draw_every = 3;
  config.odometry_noise = {0.01, 0.1, 0.01, 0.01, 0.01, 0.1};
  return config;
}

class EveryFilter : public testing::TestWithParam<std::string> {};

// Without noise there is no error. Mutations: updating before predicting, leaving out a control, starting at
// the origin instead of the log's start, recording the estimate of the step before.
TEST_P(EveryFilter, IsExactWithoutNoise) {
  const bool maps = slam::find_filter_kind(GetParam())->maps_landmarks;
  if (!maps && GetParam() != "dead_reckoning") GTEST_SKIP() << "it is blind, and moves as it likes";
  const MeasurementLog log = exact_log();
  slam::FilterConfig config;
  config.particles = 5;
  const FilterRun run = replay(log, GetParam(), config, 3);
  ASSERT_FALSE(run.failed) << run.failure;
  EXPECT_EQ(run.filter, GetParam());
  EXPECT_EQ(run.seed, 3U);
  const FilterScore result = score(run, log);
  EXPECT_LT(result.trajectory.ate_max_m, 1e-9);
  EXPECT_LT(result.trajectory.heading_rms_rad, 1e-9);
  if (!maps) return;
  // Sigma points of a first sighting see the range's curvature: r (1 - sigma^2 / 2), some 0.1 mm here.
  EXPECT_LT(result.map.rms_m, GetParam().starts_with("ufastslam") ? 2e-4 : 1e-9);
  EXPECT_EQ(result.map.found_once, 4);
}

TEST_P(EveryFilter, TheSameSeedIsTheSameRun) {
  const MeasurementLog log = exact_log();
  const slam::FilterConfig config = noisy_config();
  const FilterRun once = replay(log, GetParam(), config, 3);
  const FilterRun again = replay(log, GetParam(), config, 3);
  ASSERT_EQ(once.poses.size(), log.steps.size());
  ASSERT_EQ(once.covariances.size(), log.steps.size());
  for (std::size_t i = 0; i < once.poses.size(); ++i) {
    EXPECT_EQ(once.poses[i].x_m, again.poses[i].x_m);
    EXPECT_EQ(once.covariances[i], again.covariances[i]);
  }
  EXPECT_EQ(once.last.landmarks.size(), again.last.landmarks.size());
}

// Mutation: recording the true pose.
TEST_P(EveryFilter, NeverLooksAtTheTruth) {
  const MeasurementLog log = exact_log();
  MeasurementLog other = log;
  for (LogStep& step : other.steps) step.truth = slam::Pose{7.0, 8.0, 1.0};
  other.steps[5].truth.reset();
  for (LandmarkTruth& landmark : other.landmarks) landmark.position_m *= 2.0;
  slam::FilterConfig config;
  config.particles = 5;
  const FilterRun run = replay(log, GetParam(), config, 3);
  const FilterRun blind = replay(other, GetParam(), config, 3);
  ASSERT_EQ(run.poses.size(), blind.poses.size());
  for (std::size_t i = 0; i < run.poses.size(); ++i) {
    EXPECT_EQ(run.poses[i].x_m, blind.poses[i].x_m);
    EXPECT_EQ(run.covariances[i], blind.covariances[i]);
  }
  ASSERT_EQ(run.last.landmarks.size(), blind.last.landmarks.size());
  for (std::size_t i = 0; i < run.last.landmarks.size(); ++i)
    EXPECT_EQ(run.last.landmarks[i].position_m, blind.last.landmarks[i].position_m);
}

// What is believed at a step does not depend on what comes later: of a log that ends there it is the same, to
// the bit. Mutation: a smoother that hands back the path that it ends with.
TEST_P(EveryFilter, OfTheBeginningOfALogBelievesTheSame) {
  const MeasurementLog log = exact_log();
  const slam::FilterConfig config = noisy_config();
  const FilterRun whole = replay(log, GetParam(), config, 3);
  for (std::size_t steps = 1; steps < log.steps.size(); steps += 3) {
    MeasurementLog beginning = log;
    beginning.steps.resize(steps);
    const FilterRun run = replay(beginning, GetParam(), config, 3);
    ASSERT_EQ(run.poses.size(), steps);
    for (std::size_t i = 0; i < steps; ++i) {
      ASSERT_EQ(run.poses[i].x_m, whole.poses[i].x_m) << "step " << i << " of " << steps;
      ASSERT_EQ(run.poses[i].heading_rad, whole.poses[i].heading_rad);
      ASSERT_EQ(run.covariances[i], whole.covariances[i]);
    }
  }
}

// Mutation: one seed for all.
TEST_P(EveryFilter, AnotherSeedIsAnotherRunWhereThereAreParticles) {
  const slam::FilterConfig config = noisy_config();
  const FilterRun run = replay(exact_log(), GetParam(), config, 3);
  const FilterRun other = replay(exact_log(), GetParam(), config, 4);
  const bool draws = run.particles > 1;
  EXPECT_EQ(run.poses.back().x_m != other.poses.back().x_m, draws);
}

INSTANTIATE_TEST_SUITE_P(Filters, EveryFilter, testing::ValuesIn(slam::filter_names()));

TEST(Replay, RefusesWhatIsNoFilter) {
  EXPECT_THROW(replay(exact_log(), "kalman", {}, 0), std::invalid_argument);
}

// Velocities that are finite, and a place that is not. Mutation: keeping the pose that is not finite.
TEST(Replay, AnEstimateThatIsNotFiniteIsAFailureThatIsExplained) {
  MeasurementLog log = exact_log();
  log.steps[10].odometry[0].v_mps = std::numeric_limits<double>::max();
  log.steps[10].odometry[0].duration_s = 1e300;
  const FilterRun run = replay(log, "dead_reckoning", {}, 0);
  EXPECT_TRUE(run.failed);
  EXPECT_EQ(run.poses.size(), 10U);
  EXPECT_EQ(run.failure, "step 10: the estimate is not finite");
  EXPECT_TRUE(score(run, log).failed);
}

/// Noise that suits this data: the readings come at 67 Hz and share slip that lasts for seconds, which noise
/// that is drawn anew for each reading covers only when it is large.
slam::FilterConfig config_for_mrclam() {
  slam::FilterConfig config;
  config.particles = 50;
  config.odometry_noise = {.v_constant_mps = 0.05, .v_per_v = 1.0, .w_constant_radps = 0.3, .w_per_w = 1.0};
  return config;
}

// The real thing: MRCLAM set 7. The limits are the project's own, for the median of several seeds.
TEST(Replay, MapsARealRobotsRun) {
  const fs::path data = fs::path(STEREOBENCH_SOURCE_DIR) / ".." / "shared" / "data" / "mrclam";
  if (!fs::exists(data)) GTEST_SKIP() << "no MRCLAM data beside this checkout";
  const MeasurementLog log = read_log(data / "ds7/robot2", {0.2, 0.03}).log;
  const slam::FilterConfig config = config_for_mrclam();
  const FilterScore dead = score(replay(log, "dead_reckoning", config, 0), log);
  EXPECT_GT(dead.trajectory.ate_aligned_rms_m, 1.0);
  std::vector<FilterScore> scores;
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    scores.push_back(score(replay(log, "fastslam2", config, seed), log));
  }
  const FilterSummary summary = summarise(scores, config.particles);
  EXPECT_LT(summary.ate_aligned_median_m, 0.30);
  EXPECT_LT(summary.landmark_aligned_rms_m.mean, 0.15);
  EXPECT_EQ(summary.landmarks_found_once, 45);
  EXPECT_EQ(summary.failures, 0);
}

}  // namespace
}  // namespace stereobench::harness
