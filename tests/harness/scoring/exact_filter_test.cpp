// A filter that is exactly right, held against everything that judges filters; and two that are wrong.
#include <cmath>

#include <gtest/gtest.h>

#include "harness/scoring/replay.h"
#include "harness/scoring/score.h"
#include "tests/harness/scoring/summarise.h"
#include "tests/slam/checks.h"

namespace stereobench::harness {
namespace {

/// A lap so precise that everything is linear in what is unknown: there EKF-SLAM is exact.
slam::Drive precise_lap() {
  constexpr double kSmall = 1e-3;
  slam::Drive world;
  world.side_m = 6.0;
  world.range_sd_m *= kSmall;
  world.bearing_sd_rad *= kSmall;
  world.odometry_noise = {0.05 * kSmall, 0.0, 0.0, 0.02 * kSmall, 0.0, 0.0};
  return world;
}

/// @param claimed_variance of the sightings, over the one that they have
MeasurementLog log_of(const slam::Drive& world, std::uint64_t seed, double claimed_variance = 1.0) {
  slam::RandomStream odometry(seed, slam::Stream::kOdometry);
  slam::RandomStream sensor(seed, slam::Stream::kOracle);
  MeasurementLog log;
  int id = 0;
  for (const Eigen::Vector2d& place : world.landmarks())
    log.landmarks.push_back({id++, slam::kUnknown, place});
  slam::Pose truth;
  for (const slam::Control& control : world.controls()) {
    truth = slam::advance(truth, control);
    log.steps.push_back({.odometry = {slam::perturb(control, world.odometry_noise, odometry)},
                         .measurements = world.look(truth, sensor),
                         .truth = truth});
    for (slam::RangeBearing& seen : log.steps.back().measurements) seen.covariance *= claimed_variance;
  }
  return log;
}

FilterScore score_of(const std::string& filter, const slam::Drive& world, const MeasurementLog& log) {
  slam::FilterConfig config{.odometry_noise = world.odometry_noise};
  config.range_floor_m = config.bearing_floor_rad = 0.0;
  config.gate_probability = 1.0;
  return score(replay(log, filter, config, 1), log);
}

FilterSummary summary_of(std::uint64_t seeds, double claimed_variance = 1.0) {
  const slam::Drive world = precise_lap();
  std::vector<FilterScore> scores;
  for (std::uint64_t seed = 0; seed < seeds; ++seed)
    scores.push_back(score_of("ekf", world, log_of(world, seed, claimed_variance)));
  return summarise(scores, 1);
}

// Everything that is a test has its own level (1 %, 1 %, 5 %); a fraction's interval comes from the seeds:
// four standard errors. Mutations: squared lengths halved in the filter, or of one degree of freedom;
// ellipses of one degree of freedom.
TEST(Consistency, OfAFilterThatIsExactIsNotDoubted) {
  const FilterSummary exact = summary_of(100);
  const ConsistencySummary& c = exact.consistency;
  EXPECT_EQ(c.innovations.runs_outside, 0);
  EXPECT_EQ(c.innovations.landmarks_outside, 0);
  EXPECT_EQ(c.innovations.landmarks, 16);
  EXPECT_EQ(c.innovations.sum.refused(), 0);
  const auto sightings = static_cast<double>(c.innovations.sum.sightings());
  EXPECT_NEAR(c.innovations.nis.mean, 1.0, 4.0 / std::sqrt(sightings));
  EXPECT_EQ(exact.nees.fraction_outside, 0.0) << *exact.nees.first_outside;
  EXPECT_NEAR(exact.anees.mean, 1.0, 2.0 * exact.anees.half_width);
  for (std::size_t i = 0; i < kEllipses.size(); ++i) {
    EXPECT_NEAR(c.path[i].mean, kEllipses[i], 2.0 * c.path[i].half_width) << kEllipses[i];
    EXPECT_NEAR(c.map[i].mean, kEllipses[i], 2.0 * c.map[i].half_width) << kEllipses[i];
  }
}

// Half of the measurement's true variance is claimed: one run is enough, with every filter. Mutation: squared
// lengths halved.
TEST(Consistency, NisFindsAWrongNoiseInOneRun) {
  const slam::Drive world = precise_lap();
  for (const char* filter : {"ekf", "fastslam1", "fastslam2", "ufastslam"}) {
    const std::vector<FilterScore> one = {score_of(filter, world, log_of(world, 3, 0.5))};
    const InnovationSummary nis = summarise(one, 1).consistency.innovations;
    EXPECT_EQ(nis.runs_outside, 1) << filter;
    EXPECT_GT(nis.nis.mean, 1.3) << filter;
    EXPECT_LT(nis.run_ps.at(0), 1e-6) << filter;
  }
}

// A recorded log replayed twenty times is one experiment: what its errors are by chance is no more
// significant. Mutation: seeds of one log summed up as if they were independent.
TEST(Consistency, ReplaysOfOneLogAreOneExperiment) {
  const slam::Drive world = precise_lap();
  long doubted = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const std::vector<FilterScore> replays(20, score_of("ekf", world, log_of(world, seed)));
    const FilterSummary once = summarise(std::span(replays).first(1), 1);
    const FilterSummary summary = summarise(replays, 1, Seeds::kFilters);
    EXPECT_EQ(summary.nees.first_outside, once.nees.first_outside);
    EXPECT_EQ(summary.consistency.innovations.landmarks_outside,
              once.consistency.innovations.landmarks_outside);
    doubted += summarise(replays, 1).nees.first_outside ? 1 : 0;
  }
  EXPECT_GT(doubted, 5);  // so wrong would it be
}

// A start whose heading is off by three of the last step's deviations turns the whole world, and nothing that
// is seen can tell: the innovations are the same. The errors are not.
TEST(Consistency, ABiasOfTheStartIsSeenByNeesAndNotByNis) {
  constexpr double kOff_rad = 3e-4;
  const slam::Drive world = precise_lap();
  std::vector<FilterScore> straight;
  std::vector<FilterScore> turned;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    MeasurementLog log = log_of(world, seed);
    straight.push_back(score_of("ekf", world, log));
    log.start.heading_rad = kOff_rad;
    turned.push_back(score_of("ekf", world, log));
    EXPECT_NEAR(turned.back().consistency.innovations.run.all.ratio(),
                straight.back().consistency.innovations.run.all.ratio(), 1e-6);
  }
  const FilterSummary off = summarise(turned, 1);
  EXPECT_EQ(off.consistency.innovations.runs_outside, 0);
  EXPECT_EQ(summarise(straight, 1).nees.fraction_outside, 0.0);
  EXPECT_GT(off.nees.fraction_outside, 0.5);
  EXPECT_LT(off.consistency.path[1].mean, 0.9);
}

// Each step of the log has its record, and particles that are resampled lose ancestors, never gain.
TEST(Consistency, RecordsOfUpdatesAreAlignedWithTheSteps) {
  slam::Drive world;
  world.side_m = 6.0;
  MeasurementLog log = log_of(world, 2);
  log.steps[10].measurements.clear();
  const FilterRun run =
      replay(log, "fastslam2", {.particles = 50, .odometry_noise = world.odometry_noise}, 1);
  ASSERT_EQ(run.updates.size(), log.steps.size());
  EXPECT_TRUE(run.updates[0].innovations.empty());  // all is new
  EXPECT_FALSE(run.updates[9].innovations.empty());
  EXPECT_TRUE(run.updates[10].innovations.empty());
  EXPECT_GT(run.last.counters.resamplings, 0);
  EXPECT_EQ(run.updates.back().distinct_ancestors, 50);
  EXPECT_LT(run.updates.front().distinct_ancestors, 50);
  for (std::size_t k = 1; k < run.updates.size(); ++k)
    EXPECT_LE(run.updates[k - 1].distinct_ancestors, run.updates[k].distinct_ancestors);
}

}  // namespace
}  // namespace stereobench::harness
