/// What a floor plan shows.

#include "harness/report/plan_picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "worlds/drive/path.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A robot drives 2 m east towards a ball; another lies behind it, and a third behind a wall.
worlds::Scenario scene() {
  worlds::Scenario scenario;
  scenario.name = "scene";
  scenario.rig.intrinsics = {1024, 768, 887.0, 511.5, 383.5};
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
  EXPECT_THAT(plan, HasSubstr("3 balls (2 never in view, crossed out), 2.0 m in 5 steps"));
  // 10 m and 3 % on either side are 900 px: the wall is 8.3 m from the left.
  EXPECT_THAT(plan, HasSubstr("M766.7,564.9 L766.7,55.5"));
  EXPECT_THAT(plan, Not(HasSubstr("nan")));
}

// The grid is at whole metres here, and what is drawn at (x, y) lies where its lines say.
// Mutations: coordinates counted from the corner of the plan; y downwards; a grid that is not labelled.
TEST(PlanPicture, HasAGridWithCoordinates) {
  const worlds::Scenario scenario = scene();
  const std::string plan = draw_plan(scenario, scenario.world, view_coverage(scenario, scenario.world), {});
  EXPECT_THAT(plan, HasSubstr("x, east [m]"));
  EXPECT_THAT(plan, HasSubstr("y, north [m]"));
  // The line of x = 5 is where the wall stands, the line of y = 3 where it ends.
  EXPECT_THAT(plan, HasSubstr("<path d=\"M766.7,590.4 L766.7,30.0\" stroke=\"#ddd\""));
  EXPECT_THAT(plan, HasSubstr("<text x=\"766.7\" y=\"608.4\" fill=\"#555\" font-size=\"12\" "
                              "text-anchor=\"middle\">5</text>"));
  EXPECT_THAT(plan, HasSubstr("<path d=\"M62.0,55.5 L962.0,55.5\" stroke=\"#ddd\""));
  EXPECT_THAT(plan, HasSubstr("y=\"59.5\" fill=\"#555\" font-size=\"12\" text-anchor=\"end\">3</text>"));
}

// Law: a plan of any size has some ten grid lines a side, not two and not a hundred.
TEST(PlanPicture, HasAReadableGridAtAnySize) {
  for (double factor = 0.01; factor < 1e4; factor *= 1.7) {
    worlds::Scenario scenario = scene();
    scenario.world.balls.resize(1);
    scenario.world.walls = {{{0.0, 0.0}, {7.0 * factor, 5.0 * factor}}};
    scenario.path.resize(1);
    const std::string plan = draw_plan(scenario, scenario.world, {{0}, {0}}, {});
    std::size_t lines = 0;
    for (std::size_t at = plan.find("#ddd"); at != std::string::npos; at = plan.find("#ddd", at + 1)) ++lines;
    EXPECT_GE(lines, 10U) << factor;
    EXPECT_LE(lines, 32U) << factor;
  }
}

// Mutations: balls counted from 1; those in view named.
TEST(PlanPicture, NamesTheBallsThatAreNeverInView) {
  const worlds::Scenario scenario = scene();
  EXPECT_THAT(never_in_view(view_coverage(scenario, scenario.world)), testing::ElementsAre(1, 2));
}

// Mutations: walls or meshes left out; what one can drive over taken for a wall.
TEST(PlanPicture, MarksWhereTheDriveGoesThroughSomething) {
  worlds::Scenario scenario = scene();
  EXPECT_TRUE(drive_crossings(scenario.world, scenario.path, {}).empty());
  scenario.world.walls.push_back({{1.25, -1.0}, {1.25, 1.0}});
  const std::vector<FloorLine> outlines = {{{0.25, -1.0}, {0.25, 1.0}, true},
                                           {{0.5, -1.0}, {0.5, 1.0}, false}};
  const auto found = drive_crossings(scenario.world, scenario.path, outlines);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].step, 1U);
  EXPECT_EQ(found[1].step, 3U);
  EXPECT_THAT(draw_plan(scenario, scenario.world, view_coverage(scenario, scenario.world), outlines),
              HasSubstr("#d6006e"));
}

}  // namespace
}  // namespace stereobench::harness
