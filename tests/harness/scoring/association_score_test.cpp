// Decisions counted on cases small enough to count by hand.
#include "harness/scoring/association_score.h"

#include <gtest/gtest.h>

#include "harness/scoring/replay.h"

namespace stereobench::harness {
namespace {

using slam::kUnknown;
using slam::Outcome;

std::vector<long> counts(const AssociationScore& score) {
  return {score.correct, score.wrong, score.missed, score.imagined, score.duplicated, score.spurious};
}

// Sightings 0 and 1 founded landmarks of balls 7 and 8, sighting 2 was clutter that founded one, too.
const std::vector<int> kTruth = {7, 8, kUnknown, 7, 8, 9, kUnknown, kUnknown};

std::vector<long> judged(const slam::Decision& decision) {
  AssociationScore score;
  judge({{decision}, {0, 1, 2, decision.sighting}}, kTruth, score);
  return counts(score);
}

// Mutations: each of the branches swapped with another one.
TEST(AssociationScore, EachDecisionIsOneOfFourThings) {
  const std::vector<long> correct = {1, 0, 0, 0, 0, 0};
  const std::vector<long> wrong = {0, 1, 0, 0, 0, 0};
  const std::vector<long> missed = {0, 0, 1, 0, 0, 0};
  const std::vector<long> imagined = {0, 0, 0, 1, 0, 0};
  EXPECT_EQ(judged({3, Outcome::kUse, 0}), correct);
  EXPECT_EQ(judged({3, Outcome::kConfirm, 0}), correct);
  EXPECT_EQ(judged({3, Outcome::kUse, 1}), wrong);
  EXPECT_EQ(judged({3, Outcome::kMove, 1}), wrong);
  EXPECT_EQ(judged({3, Outcome::kUse, 2}), wrong) << "of nothing";
  EXPECT_EQ(judged({3, Outcome::kAdd, kUnknown}), missed);
  EXPECT_EQ(judged({3, Outcome::kRefuse, 0}), missed);
  EXPECT_EQ(judged({4, Outcome::kIgnore, kUnknown}), missed);
  EXPECT_EQ(judged({5, Outcome::kAdd, kUnknown}), correct) << "ball 9 was not in the map";
  EXPECT_EQ(judged({6, Outcome::kUse, 0}), wrong);
  EXPECT_EQ(judged({6, Outcome::kUse, 2}), wrong) << "clutter is not the same thing twice";
  EXPECT_EQ(judged({6, Outcome::kAdd, kUnknown}), imagined);
  EXPECT_EQ(judged({6, Outcome::kIgnore, kUnknown}), correct);
}

// Two new sightings of one frame are of two new landmarks: what the frame itself added was not there before.
// Mutation: was_mapped without its limit.
TEST(AssociationScore, WhatAFrameAddsWasNotMappedBefore) {
  AssociationScore score;
  judge({{{0, Outcome::kAdd, kUnknown}, {1, Outcome::kAdd, kUnknown}}, {0, 1}}, kTruth, score);
  EXPECT_EQ(counts(score), (std::vector<long>{2, 0, 0, 0, 0, 0}));
}

// Mutations: the first copy counted as well; clutter counted as one landmark.
TEST(AssociationScore, TheFinalMapHoldsEachLandmarkOnce) {
  std::vector<slam::LandmarkEstimate> map(6);
  for (std::size_t i = 0; i < map.size(); ++i) map[i].origin = static_cast<int>(i) + 2;
  AssociationScore score;  // clutter, 7, 8, 9, clutter, clutter
  judge_map(map, kTruth, score);
  EXPECT_EQ(counts(score), (std::vector<long>{0, 0, 0, 0, 0, 3}));
  map[0].origin = 0;
  map[4].origin = 3;
  AssociationScore twice;  // 7, 7, 8, 9, 7, clutter
  judge_map(map, kTruth, twice);
  EXPECT_EQ(counts(twice), (std::vector<long>{0, 0, 0, 0, 2, 1}));
  EXPECT_EQ(counts(twice + score), (std::vector<long>{0, 0, 0, 0, 2, 4}));
}

MeasurementLog two_looks() {
  MeasurementLog log;
  log.steps.resize(2);
  for (LogStep& step : log.steps) {
    step.measurements.resize(2);
    for (slam::RangeBearing& seen : step.measurements)
      seen.covariance = Eigen::Vector2d(0.01, 0.0001).asDiagonal();
    step.measurements[0].range_m = 5.0;
    step.measurements[1].range_m = 9.0;
    step.true_landmarks = {0, 1};
  }
  log.landmarks = {{0, 3, {5.0, 0.0}}, {1, 4, {9.0, 0.0}}};
  return log;
}

// Mutation: a log that says half of it taken at its word.
TEST(AssociationScore, IsKnownWhereTheLogSaysWhoseEverySightingIs) {
  MeasurementLog log = two_looks();
  EXPECT_EQ(true_landmarks(log), (std::vector<int>{0, 1, 0, 1}));
  EXPECT_FALSE(knows_identities(log));
  const FilterRun told = replay(log, "fastslam2", {.particles = 3}, 1);
  ASSERT_TRUE(told.association);
  EXPECT_EQ(counts(*told.association), (std::vector<long>{4, 0, 0, 0, 0, 0}));
  log.steps[1].true_landmarks.clear();
  EXPECT_TRUE(true_landmarks(log).empty());
  EXPECT_FALSE(replay(log, "fastslam2", {.particles = 3}, 1).association);
  for (LogStep& step : log.steps)
    for (slam::RangeBearing& seen : step.measurements) seen.landmark_id = 2;
  EXPECT_TRUE(knows_identities(log));
}

// Filters are not told: swapped truths change the score and nothing else.
TEST(AssociationScore, TheTruthIsForTheScoreAlone) {
  MeasurementLog log = two_looks();
  const FilterRun one = replay(log, "ekf", {}, 1);
  std::swap(log.steps[1].true_landmarks[0], log.steps[1].true_landmarks[1]);
  const FilterRun other = replay(log, "ekf", {}, 1);
  EXPECT_EQ(counts(other.association.value()), (std::vector<long>{2, 2, 0, 0, 0, 0}));
  EXPECT_EQ(one.poses.back().x_m, other.poses.back().x_m);
  EXPECT_EQ(one.last.landmarks.size(), other.last.landmarks.size());
}

}  // namespace
}  // namespace stereobench::harness
