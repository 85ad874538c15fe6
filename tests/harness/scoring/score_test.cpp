#include "harness/scoring/score.h"

#include <cmath>

#include <gtest/gtest.h>

#include "slam/models/motion.h"
#include "tests/harness/scoring/summarise.h"

namespace stereobench::harness {
namespace {

/// Four steps along x, landmark 7 seen at the last two.
MeasurementLog straight_log() {
  MeasurementLog log;
  log.landmarks = {{7, slam::kUnknown, {3.0, 1.0}}};
  for (int i = 0; i < 4; ++i) {
    LogStep step;
    step.truth = slam::Pose{static_cast<double>(i), 0.0, 0.0};
    if (i >= 2) step.measurements.push_back({});
    log.steps.push_back(step);
  }
  return log;
}

FilterRun run_with_errors(const MeasurementLog& log, const std::vector<double>& errors_m) {
  FilterRun run;
  for (std::size_t i = 0; i < errors_m.size(); ++i) {
    run.poses.push_back({log.steps[i].truth->x_m, errors_m[i], 0.0});
    run.covariances.push_back(Eigen::Matrix3d::Identity());
  }
  run.last.landmarks = {{7, slam::kUnknown, {3.0, 1.5}, Eigen::Matrix2d::Identity()}};
  return run;
}

TEST(Score, PutsPathMapAndConsistencyTogether) {
  const MeasurementLog log = straight_log();
  const FilterScore result = score(run_with_errors(log, {0.0, 3.0, 3.0, 0.0}), log);
  EXPECT_FALSE(result.failed);
  EXPECT_DOUBLE_EQ(result.trajectory.ate_rms_m, std::sqrt(4.5));
  EXPECT_DOUBLE_EQ(result.map.rms_m, 0.5);
  EXPECT_NEAR(result.map_aligned.rms_m, 0.0,
              1e-12);  // a single landmark aligns with the truth wherever it is
  EXPECT_DOUBLE_EQ(result.normalised_errors[2].value().ratio(), 3.0);
  EXPECT_FALSE(result.normalised_errors[0].has_value());
}

// The whole run lies half a metre to the left, its landmark too. Mutation: the map's own alignment twice.
TEST(Score, AMapThatIsOffLikeItsPathIsRightAfterThePathsAlignment) {
  const MeasurementLog log = straight_log();
  FilterRun run = run_with_errors(log, {0.5, 0.5, 0.5, 0.5});
  run.last.landmarks[0].position_m = log.landmarks[0].position_m + Eigen::Vector2d(0.0, 0.5);
  EXPECT_NEAR(score(run, log).map_path_aligned.rms_m, 0.0, 1e-12);
  run.last.landmarks[0].position_m = log.landmarks[0].position_m;
  EXPECT_NEAR(score(run, log).map_path_aligned.rms_m, 0.5, 1e-12);
}

/// The same estimates in a frame of their own, moved and turned against the truth's.
FilterRun in_own_frame(FilterRun run, const slam::Pose& own_from_truth) {
  for (slam::Pose& pose : run.poses) pose = slam::compose(own_from_truth, pose);
  for (slam::LandmarkEstimate& landmark : run.last.landmarks)
    landmark = moved_landmark(own_from_truth, landmark);
  return run;
}

/// A log of four steps with a second landmark, and estimates of it that are nearly right.
struct NearlyRight {
  MeasurementLog log = straight_log();
  FilterRun run = run_with_errors(log, {0.0, 0.1, -0.1, 0.0});

  NearlyRight() {
    log.landmarks.push_back({9, slam::kUnknown, {-2.0, 2.0}});
    run.last.landmarks = {{7, slam::kUnknown, {3.0, 1.1}, Eigen::Matrix2d::Identity()},
                          {9, slam::kUnknown, {-2.0, 2.0}, Eigen::Matrix2d::Identity()}};
  }
};

const slam::Pose kElsewhere{4.0, -7.0, 2.0};

// Where filters started is not known, so that errors in the frame they made are of no meaning: they are left
// out, and what can be aligned is as it would be in the truth's frame. Mutations: any raw figure kept; the
// map found by its place in the filters' frame.
TEST(Score, InAFrameOfItsOwnIsAlignedOrLeftOut) {
  NearlyRight that;
  const FilterScore there = score(that.run, that.log);
  that.log.start_is_true = false;
  for (const bool named : {true, false}) {
    FilterRun run = in_own_frame(that.run, kElsewhere);
    if (!named)
      for (slam::LandmarkEstimate& landmark : run.last.landmarks) landmark.landmark_id = slam::kUnknown;
    const FilterScore own = score(run, that.log);
    const TrajectoryScore& path = own.trajectory;
    for (const double raw :
         {path.ate_rms_m, path.ate_max_m, path.heading_rms_rad, path.final_drift, own.map.rms_m,
          own.map.max_m, own.consistency.path.within[1], own.consistency.map.within[1]})
      EXPECT_TRUE(std::isnan(raw));
    for (const auto& error : own.normalised_errors) EXPECT_FALSE(error);
    EXPECT_NEAR(path.ate_aligned_rms_m, there.trajectory.ate_aligned_rms_m, 1e-12);
    EXPECT_NEAR(own.map_aligned.rms_m, there.map_aligned.rms_m, 1e-12);
    EXPECT_NEAR(own.map_path_aligned.rms_m, there.map_path_aligned.rms_m, 1e-12);
    EXPECT_EQ(own.map.found_once, 2);
    EXPECT_EQ(own.map.spurious, 0);
    EXPECT_LT(position_error_m(own, run.poses[1], that.log.steps[1]), 0.2);
  }
}

// Without a true path the map can be aligned where landmarks are named, and else not be compared at all.
// Mutations: two landmarks without names matched with what is near in the filters' frame; the map's own
// figure under the name of the path's.
TEST(Score, WithoutATruePathAMapIsAlignedByItsNamesOrLeftOut) {
  NearlyRight that;
  const double aligned_m = score(that.run, that.log).map_aligned.rms_m;
  that.log.start_is_true = false;
  for (LogStep& step : that.log.steps) step.truth.reset();
  FilterRun run = in_own_frame(that.run, kElsewhere);
  const FilterScore named = score(run, that.log);
  EXPECT_NEAR(named.map_aligned.rms_m, aligned_m, 1e-12);
  EXPECT_EQ(named.map.found_once, 2);
  EXPECT_TRUE(std::isnan(named.map.rms_m));
  EXPECT_TRUE(std::isnan(named.map_path_aligned.rms_m));
  for (slam::LandmarkEstimate& landmark : run.last.landmarks) landmark.landmark_id = slam::kUnknown;
  const FilterScore nameless = score(run, that.log);
  EXPECT_FALSE(nameless.truth_from_estimate);
  EXPECT_TRUE(std::isnan(nameless.map_aligned.rms_m));
  EXPECT_EQ(nameless.map.found_once + nameless.map.missed + nameless.map.spurious, 0);
}

// Mutation: scoring all steps. An offset at the two sightings aligns away, the one before does not count.
TEST(Score, AtSightingsCountsOnlyStepsThatSawSomething) {
  const MeasurementLog log = straight_log();
  const FilterScore result = score(run_with_errors(log, {0.0, 9.0, 1.0, 1.0}), log);
  EXPECT_NEAR(result.ate_aligned_at_sightings_rms_m, 0.0, 1e-12);
  EXPECT_GT(result.trajectory.ate_aligned_rms_m, 1.0);
}

TEST(Score, WithoutTruthIsNotZero) {
  MeasurementLog log = straight_log();
  FilterRun run = run_with_errors(log, {0.0, 0.0, 0.0, 0.0});
  for (LogStep& step : log.steps) step.truth.reset();
  log.landmarks.clear();
  const FilterScore result = score(run, log);
  EXPECT_TRUE(std::isnan(result.trajectory.ate_rms_m));
  EXPECT_TRUE(std::isnan(result.map.rms_m));
}

TEST(Score, RefusesARunThatDoesNotFitItsLog) {
  const MeasurementLog log = straight_log();
  EXPECT_THROW(score(run_with_errors(log, {0.0, 0.0, 0.0}), log), std::invalid_argument);
}

// Mutations: a failed run that enters the mean as 0; one that is dropped without being counted.
TEST(SummariseScores, CountsFailuresAndLeavesThemOutOfMeans) {
  const MeasurementLog log = straight_log();
  FilterRun failed = run_with_errors(log, {0.0});
  failed.failed = true;
  const std::vector<FilterScore> scores = {score(run_with_errors(log, {1.0, 1.0, 1.0, 1.0}), log),
                                           score(failed, log),
                                           score(run_with_errors(log, {3.0, 3.0, 3.0, 3.0}), log)};
  const FilterSummary summary = summarise(scores, 100);
  EXPECT_EQ(summary.failures, 1);
  EXPECT_EQ(summary.particles, 100);
  EXPECT_EQ(summary.ate_rms_m.count, 2);
  EXPECT_DOUBLE_EQ(summary.ate_rms_m.mean, 2.0);
  EXPECT_DOUBLE_EQ(summary.ate_rms_m.max, 3.0);
  EXPECT_DOUBLE_EQ(summary.ate_rms_m.sd, std::sqrt(2.0));
  EXPECT_NEAR(summary.ate_aligned_rms_m.max, 0.0, 1e-12);
  EXPECT_DOUBLE_EQ(summary.landmark_rms_m.mean, 0.5);
  EXPECT_EQ(summary.landmarks_found_once, 2);
  EXPECT_EQ(summary.landmarks_missed, 0);
  ASSERT_EQ(summary.nees_by_step.size(), 4U);
  EXPECT_DOUBLE_EQ(summary.nees_by_step[2].ratio(), (1.0 / 3.0 + 3.0) / 2.0);
  EXPECT_EQ(summary.nees_by_step[2].degrees_of_freedom, 6);
  EXPECT_EQ(summary.nees.steps, 2);
  EXPECT_DOUBLE_EQ(summary.anees.mean, (1.0 / 3.0 + 3.0) / 2.0);
  EXPECT_EQ(summary.anees.count, 2);  // seeds, for steps of one run hang together
  EXPECT_DOUBLE_EQ(summary.anees.max, 3.0);
}

TEST(SummariseScores, OfNothingButFailuresIsNotZero) {
  FilterRun failed;
  failed.failed = true;
  const std::vector<FilterScore> scores = {score(failed, straight_log())};
  const FilterSummary summary = summarise(scores, 1);
  EXPECT_EQ(summary.failures, 1);
  EXPECT_TRUE(std::isnan(summary.ate_rms_m.mean));
  EXPECT_TRUE(std::isnan(summary.ate_aligned_median_m));
  EXPECT_TRUE(summary.nees_by_step.empty());
}

TEST(SummariseScores, MedianOfEvenAndOddNumbers) {
  std::vector<FilterScore> scores(3);
  scores[0].trajectory.ate_aligned_rms_m = 5.0;
  scores[1].trajectory.ate_aligned_rms_m = 1.0;
  scores[2].trajectory.ate_aligned_rms_m = 2.0;
  EXPECT_DOUBLE_EQ(summarise(scores, 1).ate_aligned_median_m, 2.0);
  scores.pop_back();
  EXPECT_DOUBLE_EQ(summarise(scores, 1).ate_aligned_median_m, 3.0);
}

}  // namespace
}  // namespace stereobench::harness
