#include "harness/scoring/landmark_map.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "slam/models/motion.h"

namespace stereobench::harness {
namespace {

const std::vector<LandmarkTruth> kTrueLandmarks = {
    {0, 5, {0.0, 0.0}}, {1, 5, {10.0, 0.0}}, {2, 6, {10.0, 1.0}}};

slam::LandmarkEstimate estimate(int id, int colour, double x_m, double y_m) {
  return {id, colour, {x_m, y_m}, Eigen::Matrix2d::Zero()};
}

TEST(LandmarkMap, KnownIdentitiesAreComparedWithTheirOwn) {
  const std::vector<slam::LandmarkEstimate> map = {estimate(1, 5, 0.0, 0.0), estimate(0, 5, 3.0, 4.0)};
  const MapScore score = score_map(map, kTrueLandmarks);
  EXPECT_DOUBLE_EQ(score.rms_m, std::sqrt((100.0 + 25.0) / 2.0));
  EXPECT_DOUBLE_EQ(score.max_m, 10.0);
  EXPECT_EQ(score.found_once, 2);
  EXPECT_EQ(score.missed, 1);
  EXPECT_EQ(score.spurious, 0);
}

// Mutation: leaving out the colour; the first estimate is nearest to landmark 2.
TEST(LandmarkMap, UnknownIdentitiesGoToTheNearestOfTheirColour) {
  const std::vector<slam::LandmarkEstimate> map = {estimate(slam::kUnknown, 5, 10.0, 1.0),
                                                   estimate(slam::kUnknown, 5, 0.0, 0.5)};
  const MapScore score = score_map(map, kTrueLandmarks);
  EXPECT_DOUBLE_EQ(score.rms_m, std::sqrt((1.0 + 0.25) / 2.0));
  EXPECT_EQ(score.found_once, 2);
  EXPECT_EQ(score.missed, 1);
}

// Mutation: taking the last one within the limit.
TEST(LandmarkMap, OfSeveralWithinTheLimitTheNearestIsTheOwner) {
  const std::vector<LandmarkTruth> close = {{0, 5, {0.0, 0.0}}, {1, 5, {1.0, 0.0}}, {2, 5, {2.0, 0.0}}};
  for (const LandmarkTruth& landmark : close) {
    const std::vector<slam::LandmarkEstimate> map = {
        estimate(slam::kUnknown, 5, landmark.position_m.x() + 0.25, 0.0)};
    EXPECT_DOUBLE_EQ(score_map(map, close, {}, 10.0).rms_m, 0.25) << landmark.landmark_id;
  }
}

// Mutations: counting a second estimate of one landmark as another, or as spurious; no limit.
TEST(LandmarkMap, CountsTwinsMissedAndSpurious) {
  const std::vector<slam::LandmarkEstimate> map = {
      estimate(slam::kUnknown, 5, 0.1, 0.0), estimate(slam::kUnknown, 5, -0.1, 0.0),
      estimate(slam::kUnknown, 6, 10.0, 3.01), estimate(slam::kUnknown, 7, 0.0, 0.0),
      estimate(9, 5, 0.0, 0.0)};
  const MapScore score = score_map(map, kTrueLandmarks, {}, 2.0);
  EXPECT_EQ(score.duplicated, 1);
  EXPECT_EQ(score.found_once, 0);
  EXPECT_EQ(score.missed, 2);
  EXPECT_EQ(score.spurious, 3);
  EXPECT_NEAR(score.rms_m, 0.1, 1e-15);
}

TEST(LandmarkMap, TheLimitItselfStillBelongs) {
  const std::vector<slam::LandmarkEstimate> map = {estimate(slam::kUnknown, 6, 10.0, 3.0)};
  EXPECT_EQ(score_map(map, kTrueLandmarks, {}, 2.0).found_once, 1);
}

// Mutations: applying the inverse of the alignment, a wrong sign in its rotation.
TEST(LandmarkMap, IsMovedByTheAlignmentFirst) {
  const slam::Pose truth_from_estimate{11.0, -2.0, M_PI / 2.0};
  // Turned by a quarter to the left and shifted, (3, 1) comes to (10, 1), landmark 2.
  const std::vector<slam::LandmarkEstimate> map = {estimate(slam::kUnknown, 6, 3.0, 1.0)};
  EXPECT_EQ(score_map(map, kTrueLandmarks).spurious, 1);
  EXPECT_NEAR(score_map(map, kTrueLandmarks, truth_from_estimate).rms_m, 0.0, 1e-15);
}

// Mutations: aligning estimates with landmarks of another identity, or the truth with the estimates.
TEST(LandmarkMap, AlignmentUndoesAnyMotionOfTheWholeMap) {
  const slam::Pose moved_from_truth{0.7, -0.4, 2.5};
  std::vector<slam::LandmarkEstimate> map;
  for (const LandmarkTruth& landmark : kTrueLandmarks) {
    const slam::Pose place =
        slam::compose(moved_from_truth, {landmark.position_m.x(), landmark.position_m.y(), 0.0});
    map.push_back(estimate(landmark.landmark_id, landmark.colour_class, place.x_m, place.y_m));
  }
  EXPECT_GT(score_map(map, kTrueLandmarks).rms_m, 0.5);
  EXPECT_NEAR(score_map(map, kTrueLandmarks, align_map(map, kTrueLandmarks)).rms_m, 0.0, 1e-12);
}

TEST(LandmarkMap, AnEmptyMapMissesAllAndAnEmptyTruthOwnsNothing) {
  const MapScore none = score_map({}, kTrueLandmarks);
  EXPECT_EQ(none.missed, 3);
  EXPECT_TRUE(std::isnan(none.rms_m));
  const std::vector<slam::LandmarkEstimate> map = {estimate(0, 5, 0.0, 0.0)};
  EXPECT_EQ(score_map(map, {}).spurious, 1);
  EXPECT_TRUE(std::isnan(score_map(map, {}).rms_m));
}

}  // namespace
}  // namespace stereobench::harness
