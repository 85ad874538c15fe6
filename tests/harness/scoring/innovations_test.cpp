#include "harness/scoring/innovations.h"

#include <cmath>

#include <gtest/gtest.h>

#include "slam/math/random.h"

namespace stereobench::harness {
namespace {

constexpr int kLandmarks = 10;

MeasurementLog log_of(std::size_t steps) {
  MeasurementLog log;
  for (int id = 0; id < kLandmarks; ++id) log.landmarks.push_back({id, slam::kUnknown, {1.0 * id, 0.0}});
  for (std::size_t k = 0; k < steps; ++k) {
    log.steps.push_back({.truth = slam::Pose{}});
    for (int id = 0; id < kLandmarks; ++id)
      log.steps.back().measurements.push_back({.range_m = 1.0 * id, .landmark_id = id});
  }
  return log;
}

/// Consistent innovations; those of one landmark are too long by a factor.
InnovationScore drawn(std::uint64_t seed, int bad_landmark, double factor) {
  const MeasurementLog log = log_of(20);
  slam::RandomStream random(seed, slam::Stream::kWorld);
  FilterRun run;
  for (std::size_t k = 0; k < log.steps.size(); ++k) {
    run.updates.emplace_back();
    for (int id = kLandmarks; id-- > 0;) {  // in an order of their own
      const Eigen::Vector2d n(random.normal(), random.normal());
      run.updates.back().innovations.push_back({id, (id == bad_landmark ? factor : 1.0) * n.squaredNorm()});
    }
  }
  return score_innovations(run, log);
}

TEST(ScoreInnovations, SumsUpByRunAndLandmark) {
  FilterRun run;
  run.updates.resize(2);
  run.updates[0].innovations = {{3, 1.0}, {2, 20.0, true}};
  run.updates[1].innovations = {{3, 4.0}};
  MeasurementLog log = log_of(2);
  log.landmarks[2].landmark_id = 100;  // the sighting's landmark 2 is nobody's
  const InnovationScore score = score_innovations(run, log);
  EXPECT_EQ(score.run.sightings(), 3);
  EXPECT_EQ(score.run.refused(), 1);
  EXPECT_DOUBLE_EQ(score.run.all.ratio(), 25.0 / 6.0);
  EXPECT_DOUBLE_EQ(score.run.used.ratio(), 5.0 / 4.0);
  ASSERT_EQ(score.by_landmark.size(), 1U);
  EXPECT_DOUBLE_EQ(score.by_landmark.at(3).all.sum, 5.0);
}

// 400 studies of 5 consistent runs and 10 landmarks: one in a hundred finds a run outside, and one a
// landmark; 4
// +- 2 each, five deviations. Mutations: no correction for their number (20 and 38); one degree of freedom
// each.
TEST(TallyInnovations, FindsNothingWhereAllIsConsistent) {
  int with_run = 0;
  int with_landmark = 0;
  for (std::uint64_t study = 0; study < 400; ++study) {
    InnovationTally tally;
    for (std::uint64_t seed = 0; seed < 5; ++seed) tally.add(drawn(5 * study + seed, -1, 1.0));
    const InnovationSummary summary = tally.summary();
    with_run += summary.runs_outside > 0 ? 1 : 0;
    with_landmark += summary.landmarks_outside > 0 ? 1 : 0;
  }
  EXPECT_LE(with_run, 14);
  EXPECT_LE(with_landmark, 14);
}

TEST(TallyInnovations, FindsTheLandmarkThatIsWrong) {
  InnovationTally tally;
  for (const std::uint64_t seed : {1U, 2U}) tally.add(drawn(seed, 6, 3.0));
  const InnovationSummary summary = tally.summary();
  EXPECT_EQ(summary.landmarks, kLandmarks);
  EXPECT_EQ(summary.landmarks_outside, 1);
  EXPECT_EQ(summary.worst.value().landmark_id, 6);
  EXPECT_EQ(summary.worst->sum.sightings(), 40);
  EXPECT_EQ(summary.sum.sightings(), 400);
}

TEST(TallyInnovations, OfNothingIsNothing) {
  const InnovationSummary summary = InnovationTally().summary();
  EXPECT_TRUE(std::isnan(summary.nis.mean));
  EXPECT_FALSE(summary.worst);
  InnovationTally blind;
  for (int run = 0; run < 2; ++run) blind.add({});
  EXPECT_EQ(blind.summary().runs_outside, 0);
}

}  // namespace
}  // namespace stereobench::harness
