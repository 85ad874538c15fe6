/// What a floor plan shows.

#include "harness/report/plan_picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "worlds/path.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A robot drives 2 m east towards a ball; another lies behind it, and a third behind a wall.
worlds::Scenario scene() {
  worlds::Scenario scenario;
  scenario.name = "scene";
  scenario.rig.camera = {1024, 768, 887.0, 511.5, 383.5};
  scenario.rig.baseline_m = 0.12;
  scenario.rig.height_m = 0.3;
  scenario.world.balls = {{{4.0, 0.0, 0.1}, 0.1, 0}, {{-3.0, 0.0, 0.1}, 0.1, 1}, {{7.0, 0.5, 0.1}, 0.1, 2}};
  scenario.world.walls = {{{5.0, -3.0}, {5.0, 3.0}, 2.5, worlds::Material::kPlaster}};
  scenario.path = worlds::drive_polyline(
      {.points_m = {{0.0, 0.0}, {2.0, 0.0}}, .corner_radius_m = 0.1, .speed_mps = 1.0, .step_s = 0.5});
  return scenario;
}

// Mutations: balls counted through walls, or behind the robot.
TEST(PlanPicture, CountsWhatIsInViewAtEachStepAndForEachBall) {
  const worlds::Scenario scenario = scene();
  const ViewCoverage coverage = view_coverage(scenario, scenario.world);
  EXPECT_THAT(coverage.balls_in_view, testing::ElementsAre(1, 1, 1, 1, 1));
  EXPECT_THAT(coverage.steps_seen, testing::ElementsAre(5, 0, 0));
}

TEST(PlanPicture, DrawsWallsDriveAndBallsAndTheSameBytes) {
  const worlds::Scenario scenario = scene();
  const ViewCoverage coverage = view_coverage(scenario, scenario.world);
  const std::string plan = draw_plan(scenario, scenario.world, coverage, {});
  EXPECT_EQ(plan, draw_plan(scenario, scenario.world, coverage, {}));
  EXPECT_THAT(plan, HasSubstr("rgb(229,0,0)"));
  EXPECT_THAT(plan, HasSubstr("3 balls (2 never in view), 2.0 m in 5 steps"));
  // 10 m are 900 px: the wall is 8 m from the left, and its southern end at the bottom.
  EXPECT_THAT(plan, HasSubstr("M750.0,570.0 L750.0,30.0"));
  EXPECT_THAT(plan, Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace stereobench::harness
