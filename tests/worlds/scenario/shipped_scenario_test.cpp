// The scenarios in assets/scenarios keep what their comments promise, for the seeds that they name.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "slam/models/measurement.h"
#include "slam/models/motion.h"
#include "tests/worlds/scenario/read_scenario.h"
#include "tests/worlds/visibility/views.h"
#include "worlds/drive/path.h"
#include "worlds/oracle.h"

namespace stereobench::worlds {
namespace {

Scenario shipped(const std::string& name) {
  return read_scenario(fmt::format("{}/assets/scenarios/{}.yaml", STEREOBENCH_SOURCE_DIR, name));
}

/// The least clearance between the drive and any ball's surface.
double clearance_m(const Scenario& scenario, const World& world) {
  double least_m = 1e9;
  for (const PathStep& step : scenario.path) {
    for (const Ball& ball : world.balls) {
      least_m =
          std::min(least_m, slam::predict_sighting(step.pose, ball.centre_m.head<2>()).x() - ball.radius_m);
    }
  }
  return least_m;
}

/// Rms distance of dead reckoning from the truth, the mean over seeds.
double dead_reckoning_rms_m(const Scenario& scenario, std::uint64_t seeds) {
  double sum_m = 0.0;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    slam::RandomStream noise(seed, slam::Stream::kOdometry);
    slam::Pose pose = scenario.path.front().pose;
    double squares = 0.0;
    for (const PathStep& step : scenario.path) {
      for (const slam::Control& control : step.controls) {
        pose = slam::advance(pose, slam::perturb(control, scenario.odometry_noise, noise));
      }
      squares += std::pow(pose.x_m - step.pose.x_m, 2) + std::pow(pose.y_m - step.pose.y_m, 2);
    }
    sum_m += std::sqrt(squares / static_cast<double>(scenario.path.size()));
  }
  return sum_m / static_cast<double>(seeds);
}

TEST(BallCircle, IsThePapersScenarioOne) {
  const Scenario scenario = shipped("ball_circle");
  EXPECT_EQ(scenario.world.balls.size(), 18U);
  EXPECT_EQ(scenario.path.size(), 73U);
  EXPECT_EQ(scenario.path[36].stamp_ns, 72000000000);
  EXPECT_EQ(scenario.rig.intrinsics.width_px, 1024);
  EXPECT_EQ(scenario.rig.intrinsics.height_px, 768);
  for (const PathStep& step : scenario.path) {
    EXPECT_NEAR(std::hypot(step.pose.x_m, step.pose.y_m - 1), 1.0, 1e-12);
  }
  const slam::Control control = scenario.path[1].controls.at(0);
  EXPECT_NEAR(control.v_mps, std::numbers::pi / 36, 1e-16);
  EXPECT_NEAR(control.w_radps, std::numbers::pi / 36, 1e-16);
}

// Catches: a ball moved behind another, off the image or onto the robot's way.
TEST(BallCircle, ShowsEachBallAndTwoAtATimeForEverySeed) {
  const Scenario scenario = shipped("ball_circle");
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const World world = world_for_seed(scenario, seed);
    const Views views = views_of(scenario, world, 4.0);
    EXPECT_GE(std::ranges::min(views.balls_in_view), 1) << seed;
    EXPECT_GE(std::ranges::count_if(views.balls_in_view, [](int n) { return n >= 2; }), 69) << seed;
    EXPECT_GE(std::ranges::min(views.steps_seen), 8) << seed;
    EXPECT_GT(views.nearest_m, 0.6) << seed;
    EXPECT_GT(clearance_m(scenario, world), 0.3) << seed;
  }
}

TEST(BallCircle, LeavesDeadReckoningClearlyOff) {
  const double rms_m = dead_reckoning_rms_m(shipped("ball_circle"), 100);
  EXPECT_GT(rms_m, 0.15);
  EXPECT_LT(rms_m, 0.35);
}

TEST(Corridor, IsALapAroundTheBuildingAndSomeMore) {
  const Scenario scenario = shipped("corridor");
  EXPECT_GE(scenario.world.balls.size(), 40U);
  EXPECT_LE(scenario.path.size(), 300U);
  EXPECT_NEAR(length_m(scenario.path), 147.74, 0.01);
  double nearest_m = 1e9;
  const Eigen::Vector2d start = {scenario.path.front().pose.x_m, scenario.path.front().pose.y_m};
  for (std::size_t k = 200; k < scenario.path.size(); ++k) {
    nearest_m = std::min(nearest_m, slam::predict_sighting(scenario.path[k].pose, start).x());
  }
  EXPECT_LT(nearest_m, 0.25) << "the loop closes";
  const slam::Pose& end = scenario.path.back().pose;
  EXPECT_NEAR(end.x_m - start.x(), 10.0, 1e-6);
  EXPECT_NEAR(end.y_m, start.y(), 1e-6);
}

// The reader refuses less than 10 m; this one does not ask the reader.
TEST(Corridor, ReusesColoursButNeverTwiceWithinTenMetres) {
  const Scenario scenario = shipped("corridor");
  EXPECT_EQ(scenario.identity, Identity::kColourClass);
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const World world = world_for_seed(scenario, seed);
    for (std::size_t i = 0; i < world.balls.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const double distance_m = (world.balls[i].centre_m - world.balls[j].centre_m).norm();
        EXPECT_TRUE(world.balls[i].colour != world.balls[j].colour || distance_m >= 10.0) << i << " " << j;
      }
    }
  }
}

TEST(Corridor, HasAtLeastFortyBallsBesideDoors) {
  const Scenario scenario = shipped("corridor");
  const auto beside_a_door = [&](const Ball& ball) {
    return std::ranges::any_of(scenario.world.meshes, [&](const MeshInstance& door) {
      return (door.position_m - ball.centre_m).head<2>().norm() < 1.1;
    });
  };
  EXPECT_GE(std::ranges::count_if(scenario.world.balls, beside_a_door), 40);
}

// Catches: a ball behind a corner, a stretch or a turn where the robot would be blind.
TEST(Corridor, ShowsEachBallAndTwoAtATimeForEverySeed) {
  const Scenario scenario = shipped("corridor");
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const World world = world_for_seed(scenario, seed);
    const Views views = views_of(scenario, world, 8.0);
    EXPECT_GE(std::ranges::min(views.balls_in_view), 1) << seed;
    EXPECT_LE(std::ranges::max(views.balls_in_view), 7) << seed;
    EXPECT_GE(std::ranges::count_if(views.balls_in_view, [](int n) { return n >= 2; }), 290) << seed;
    const Views near = views_of(scenario, world, 6.0);
    EXPECT_GE(std::ranges::min(near.steps_seen), 3) << seed;
    EXPECT_GT(near.nearest_m, 0.7) << seed;
    EXPECT_GT(clearance_m(scenario, world), 0.5) << seed;
  }
}

// Catches: walls that hide nothing. The inner block's far side must not be seen through it.
TEST(Corridor, HidesBallsBehindTheInnerBlock) {
  Scenario scenario = shipped("corridor");
  const Views with_walls = views_of(scenario, scenario.world, 60.0);
  World open = scenario.world;
  open.walls.clear();
  const Views without_walls = views_of(scenario, open, 60.0);
  int more = 0;
  for (std::size_t k = 0; k < scenario.path.size(); ++k) {
    if (without_walls.balls_in_view[k] > with_walls.balls_in_view[k]) ++more;
  }
  EXPECT_GT(more, 200);
}

TEST(Corridor, LeavesDeadReckoningMetresOff) {
  const double rms_m = dead_reckoning_rms_m(shipped("corridor"), 100);
  EXPECT_GT(rms_m, 4.0);
  EXPECT_LT(rms_m, 8.0);
}

TEST(OpenField, IsThePapersSimulation) {
  const Scenario scenario = shipped("open_field");
  EXPECT_EQ(scenario.world.balls.size(), 40U);
  EXPECT_NEAR(length_m(scenario.path), 156.0, 0.001);
  EXPECT_EQ(scenario.path[1].stamp_ns, 500000000);
  EXPECT_EQ(scenario.odometry_noise.v_constant_mps, 0.02);
  EXPECT_DOUBLE_EQ(scenario.odometry_noise.w_constant_radps, 0.2 * std::numbers::pi / 180);
  EXPECT_EQ(scenario.oracle.range_sd_m, 0.3);
  EXPECT_DOUBLE_EQ(scenario.oracle.bearing_sd_rad, 3 * std::numbers::pi / 180);
  EXPECT_EQ(scenario.oracle.max_range_m, 30.0);
  EXPECT_DOUBLE_EQ(scenario.oracle.field_of_view_rad, std::numbers::pi);
  EXPECT_GT(clearance_m(scenario, scenario.world), 1.0);
  for (const Ball& ball : scenario.world.balls)
    EXPECT_LE(ball.centre_m.head<2>().cwiseAbs().maxCoeff(), 50.0);
}

TEST(OpenField, ShowsThirtySevenLandmarksAndSomeAtEachStep) {
  const Scenario scenario = shipped("open_field");
  OracleSensor exact = scenario.oracle;
  exact.range_sd_m = exact.bearing_sd_rad = 0.0;
  slam::RandomStream noise(0, slam::Stream::kOracle);
  std::set<int> seen;
  for (const PathStep& step : scenario.path) {
    const auto sightings = sense(scenario.world, step.pose, exact, scenario.identity, noise).measurements;
    EXPECT_GE(sightings.size(), 1U);
    for (const auto& sighting : sightings) seen.insert(sighting.landmark_id);
  }
  EXPECT_EQ(seen.size(), 37U);
}

}  // namespace
}  // namespace stereobench::worlds
