#include "slam/association/contradiction.h"

#include <gtest/gtest.h>

#include "tests/slam/checks.h"

namespace stereobench::slam {
namespace {

// Catches patience that is shorter or longer than five, and a landmark seen twice that overrules the
// odometry.
TEST(JudgeContradiction, BlamesSightingThenLandmarkThenPose) {
  const TrackRecord fresh{.uses = 10, .refusals = 3};
  const TrackRecord persistent{.uses = 10, .refusals = 4};
  const TrackRecord unconfirmed{.uses = 2, .refusals = 4};
  for (const bool corroborated : {false, true})
    EXPECT_EQ(judge_contradiction(fresh, false, corroborated), Outcome::kRefuse);
  EXPECT_EQ(judge_contradiction(persistent, false, false), Outcome::kUse);
  EXPECT_EQ(judge_contradiction(persistent, false, true), Outcome::kMove);
  EXPECT_EQ(judge_contradiction(unconfirmed, false, false), Outcome::kMove);
}

// Mutation: counts that wrap around, so that a landmark seen 65,536 times is one that nobody knows.
TEST(TrackRecord, CountsAndStopsAtTheEnd) {
  TrackRecord record;
  record.contradict();
  EXPECT_EQ(record.refusals, 1);
  record.agree();
  EXPECT_EQ(record.uses, 2);
  EXPECT_EQ(record.refusals, 0);
  for (int i = 0; i < 70'000; ++i) record.agree();
  EXPECT_EQ(record.uses, 65'535);
}

// Where nothing else can have been seen, no patience is needed, and no confirmation.
TEST(JudgeContradiction, BlamesThePoseAtOnceWhenTheLandmarkIsCertain) {
  EXPECT_EQ(judge_contradiction({.uses = 1}, true, false), Outcome::kUse);
  EXPECT_EQ(judge_contradiction({.uses = 1}, true, true), Outcome::kRefuse);
}

}  // namespace
}  // namespace stereobench::slam
