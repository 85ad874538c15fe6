/// `stereobench world`: what it says of a drive beside its plan.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kWall = "world.walls=[{corners_m: [[-3, 0.5], [3, 0.5]]}]";

// Mutations: no warning; one without the step; a warning that fails the run.
TEST(WorldCommand, WarnsOfADriveThroughAWall) {
  const TestFolder scratch;
  const Outcome clear = run_stereobench({"world", scenario_path("ball_circle")});
  EXPECT_EQ(clear.exit_code, 0) << clear.err;
  EXPECT_THAT(clear.err, IsEmpty());
  const Outcome through = run_stereobench({"world", scenario_path("ball_circle"), "--set", kWall});
  EXPECT_EQ(through.exit_code, 0);
  EXPECT_THAT(through.err, HasSubstr("warning: the drive goes through a wall or a mesh at step "));
  const Outcome run = run_stereobench({"run", scenario_path("ball_circle"), "--set", kWall, "--set",
                                       "path.laps=0.3", "--set", "gates=[]", "--seeds", "0", "--filters",
                                       "dead_reckoning", "--out", scratch.path().string()});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.err, HasSubstr("warning: the drive goes through a wall or a mesh at step "));
}

// Mutation: how many, and not which.
TEST(WorldCommand, NamesTheBallsThatAreNeverInView) {
  const Outcome outcome = run_stereobench({"world", scenario_path("ball_circle"), "--set", "path.laps=0.05",
                                           "--set", "world.balls[3].at_m[0]=-80"});
  EXPECT_THAT(outcome.out, testing::ContainsRegex("balls never in view: ([0-9]+, )*3(,|\n)")) << outcome.out;
}

// One word on all command lines, and the other still read.
TEST(WorldCommand, TakesOneSeedByEitherName) {
  for (const char* word : {"--seeds", "--seed"})
    EXPECT_EQ(run_stereobench({"world", scenario_path("ball_circle"), word, "3"}).exit_code, 0) << word;
  const Outcome many = run_stereobench({"world", scenario_path("ball_circle"), "--seeds", "0..3"});
  EXPECT_EQ(many.exit_code, 2);
  EXPECT_THAT(many.err, HasSubstr("a plan is of one seed (got 4)"));
}

}  // namespace
}  // namespace stereobench::harness
