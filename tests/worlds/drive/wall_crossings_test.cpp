#include "worlds/drive/wall_crossings.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "slam/math/elementary.h"
#include "worlds/drive/path.h"

namespace stereobench::worlds {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

GroundTruth drive_east() {
  return drive_polyline(
      {.points_m = {{0.0, 0.0}, {4.0, 0.0}}, .corner_radius_m = 0.1, .speed_mps = 1.0, .step_s = 0.5});
}

// Mutations: the wall taken for an endless line; steps counted from 0; the step before.
TEST(WallCrossings, NameTheStepAndThePlace) {
  const auto found = crossings(drive_east(), std::vector<FloorSegment>{{{1.75, -1.0}, {1.75, 1.0}},
                                                                       {{1.0, 0.5}, {1.0, 2.0}},
                                                                       {{3.0, 3.0}, {3.2, -0.5}},
                                                                       {{-1.0, -1.0}, {-1.0, 1.0}}});
  ASSERT_THAT(found, SizeIs(2));
  EXPECT_EQ(found[0].step, 4U);
  EXPECT_NEAR((found[0].at_m - Eigen::Vector2d(1.75, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_EQ(found[1].step, 7U);
}

// Law: a full circle crosses a spoke once, and a wall across it twice, whatever the steps: it is the arc that
// counts, not the line from step to step. Mutation: chords from step to step.
TEST(WallCrossings, FollowTheArcBetweenSteps) {
  for (const double step_s : {0.1, 1.0, 2.9}) {
    const GroundTruth path =
        drive_circle({.radius_m = 1.0, .speed_mps = 1.0, .laps = 0.99, .step_s = step_s});
    for (int i = 1; i < 20; ++i) {
      const auto [s, c] = slam::sine_cosine(0.3 * i);
      const Eigen::Vector2d centre(0.0, 1.0);
      const Eigen::Vector2d spoke(c, s);
      const FloorSegment outer = {centre + 0.95 * spoke, centre + 2.0 * spoke};
      EXPECT_THAT(crossings(path, std::vector{outer}), SizeIs(1)) << step_s << " " << i;
      const FloorSegment inner = {centre, centre + 0.95 * spoke};
      EXPECT_THAT(crossings(path, std::vector{inner}), IsEmpty()) << step_s << " " << i;
    }
  }
}

// The corners of walls belong to them: nobody slips through between two. Mutation: ends left out.
TEST(WallCrossings, NobodySlipsThroughWhereWallsMeet) {
  const std::vector<Wall> walls = {{{2.0, -1.0}, {2.0, 0.0}}, {{2.0, 0.0}, {2.0, 1.0}}};
  EXPECT_THAT(crossings(drive_east(), feet_of(walls)), testing::Not(IsEmpty()));
}

}  // namespace
}  // namespace stereobench::worlds
