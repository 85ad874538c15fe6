#include "harness/scoring/trajectory.h"

#include <cmath>

#include <gtest/gtest.h>

#include "slam/math/random.h"
#include "slam/models/motion.h"

namespace stereobench::harness {
namespace {

slam::Pose random_pose(slam::RandomStream& random, double size_m) {
  return {size_m * random.normal(), size_m * random.normal(), slam::wrap_angle(10.0 * random.normal())};
}

/// Some 40 true poses with estimates that are off by a little.
std::vector<PosePair> noisy_pairs(slam::RandomStream& random, double noise_m) {
  std::vector<PosePair> pairs;
  for (int i = 0; i < 40; ++i) {
    const slam::Pose truth = random_pose(random, 10.0);
    slam::Pose estimate = truth;
    estimate.x_m += noise_m * random.normal();
    estimate.y_m += noise_m * random.normal();
    pairs.push_back({estimate, truth});
  }
  return pairs;
}

double aligned_squares(const std::vector<PosePair>& pairs, const slam::Pose& truth_from_estimate) {
  double squares = 0.0;
  for (const PosePair& pair : pairs) {
    const slam::Pose moved = slam::compose(truth_from_estimate, pair.estimate);
    squares += std::pow(moved.x_m - pair.truth.x_m, 2) + std::pow(moved.y_m - pair.truth.y_m, 2);
  }
  return squares;
}

class AnyPath : public testing::TestWithParam<std::uint64_t> {
 protected:
  slam::RandomStream random{GetParam(), slam::Stream::kWorld};
};

// Mutations: exchanged mean positions, the sine's sign, the inverse transform.
TEST_P(AnyPath, AlignmentRecoversAnyMotionOfThePlane) {
  const slam::Pose truth_from_estimate = random_pose(random, 5.0);
  std::vector<PosePair> pairs = noisy_pairs(random, 0.0);
  for (PosePair& pair : pairs) pair.truth = slam::compose(truth_from_estimate, pair.estimate);
  const TrajectoryScore score = score_trajectory(pairs);
  EXPECT_NEAR(score.truth_from_estimate.x_m, truth_from_estimate.x_m, 1e-12);
  EXPECT_NEAR(score.truth_from_estimate.y_m, truth_from_estimate.y_m, 1e-12);
  EXPECT_NEAR(slam::wrap_angle(score.truth_from_estimate.heading_rad - truth_from_estimate.heading_rad), 0.0,
              1e-13);
  EXPECT_NEAR(score.ate_aligned_rms_m, 0.0, 1e-12);
  EXPECT_NEAR(score.ate_aligned_max_m, 0.0, 1e-12);
  EXPECT_NEAR(score.rpe_rms_m, 0.0, 1e-12);
  EXPECT_NEAR(score.rpe_heading_rms_rad, 0.0, 1e-12);
  EXPECT_GT(score.ate_rms_m, 0.1);
}

// No other motion does better: the independent check of the closed form.
TEST_P(AnyPath, NoNeighbourOfTheAlignmentIsBetter) {
  const std::vector<PosePair> pairs = noisy_pairs(random, 3.0);
  const slam::Pose best = align(pairs);
  const double least = aligned_squares(pairs, best);
  for (int i = 0; i < 100; ++i) {
    const slam::Pose other{best.x_m + 0.01 * random.normal(), best.y_m + 0.01 * random.normal(),
                           best.heading_rad + 0.001 * random.normal()};
    EXPECT_LT(least, aligned_squares(pairs, other) + 1e-9);
  }
  EXPECT_LE(score_trajectory(pairs).ate_aligned_rms_m, score_trajectory(pairs).ate_rms_m);
}

TEST_P(AnyPath, TheTruthHasNoError) {
  std::vector<PosePair> pairs = noisy_pairs(random, 1.0);
  for (PosePair& pair : pairs) pair.estimate = pair.truth;
  const TrajectoryScore score = score_trajectory(pairs);
  EXPECT_EQ(score.ate_rms_m, 0.0);
  EXPECT_EQ(score.ate_max_m, 0.0);
  EXPECT_EQ(score.heading_rms_rad, 0.0);
  EXPECT_EQ(score.final_drift, 0.0);
  EXPECT_NEAR(score.ate_aligned_rms_m, 0.0, 1e-12);
  EXPECT_NEAR(score.rpe_rms_m, 0.0, 1e-12);
  EXPECT_EQ(score.scored_steps, 40);
}

INSTANTIATE_TEST_SUITE_P(Seeds, AnyPath, testing::Range<std::uint64_t>(0, 50));

TEST(Trajectory, ByHand) {
  const std::vector<PosePair> pairs = {
      {{0, 0, 0}, {0, 0, 0}}, {{1, 3, 0.3}, {1, 0, 0}}, {{2, 4, -0.4}, {2, 0, 0}}};
  const TrajectoryScore score = score_trajectory(pairs, 1);
  EXPECT_DOUBLE_EQ(score.ate_rms_m, std::sqrt(25.0 / 3.0));
  EXPECT_DOUBLE_EQ(score.ate_max_m, 4.0);
  EXPECT_NEAR(score.heading_rms_rad, 0.5 / std::sqrt(3.0), 1e-15);
  EXPECT_DOUBLE_EQ(score.final_drift, 2.0);  // 4 m off after 2 m
  EXPECT_EQ(score.scored_steps, 3);
}

// Mutation: heading error without wrapping would be near 2 pi.
TEST(Trajectory, HeadingErrorsTakeTheShorterWay) {
  const std::vector<PosePair> pairs = {{{0, 0, 3.1}, {0, 0, -3.1}}};
  EXPECT_NEAR(score_trajectory(pairs).heading_rms_rad, 2.0 * M_PI - 6.2, 1e-12);
}

// A path that bends by 0.1 rad at each step: the error over k steps is that of the motion, not of the place.
TEST(Trajectory, RelativeErrorIsThatOfTheMotion) {
  std::vector<PosePair> pairs;
  slam::Pose truth;
  slam::Pose estimate{7.0, -3.0, 1.0};
  for (int i = 0; i < 20; ++i) {
    pairs.push_back({estimate, truth});
    truth = slam::compose(truth, {1.0, 0.0, 0.1});
    estimate = slam::compose(estimate, {1.25, 0.0, 0.1});
  }
  EXPECT_NEAR(score_trajectory(pairs, 1).rpe_rms_m, 0.25, 1e-12);
  EXPECT_NEAR(score_trajectory(pairs, 1).rpe_heading_rms_rad, 0.0, 1e-12);
  EXPECT_GT(score_trajectory(pairs, 2).rpe_rms_m, 0.49);
  EXPECT_TRUE(std::isnan(score_trajectory(pairs, 20).rpe_rms_m));
  EXPECT_THROW(score_trajectory(pairs, 0), std::invalid_argument);
}

TEST(Trajectory, OnlyStepsWithTruthCount) {
  MeasurementLog log;
  log.steps.resize(3);
  log.steps[1].truth = slam::Pose{1.0, 0.0, 0.0};
  const std::vector<slam::Pose> poses = {{9, 9, 0}, {1, 2, 0}, {9, 9, 0}};
  const std::vector<PosePair> pairs = pair_with_truth(poses, log);
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_DOUBLE_EQ(score_trajectory(pairs).ate_rms_m, 2.0);
  log.steps.pop_back();
  EXPECT_THROW(pair_with_truth(poses, log), std::invalid_argument);
}

TEST(Trajectory, NothingToScoreIsNotZero) {
  const TrajectoryScore score = score_trajectory({});
  EXPECT_TRUE(std::isnan(score.ate_rms_m));
  EXPECT_TRUE(std::isnan(score.ate_aligned_max_m));
  EXPECT_TRUE(std::isnan(score.heading_rms_rad));
  EXPECT_TRUE(std::isnan(score.final_drift));
  EXPECT_EQ(score.truth_from_estimate.x_m, 0.0);
}

}  // namespace
}  // namespace stereobench::harness
