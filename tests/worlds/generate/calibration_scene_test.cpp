// Calibration scenes: what cameras are calibrated in.
#include "worlds/generate/calibration_scene.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "vision/camera/rig.h"

namespace stereobench::worlds {
namespace {

Scenario cameras() {
  Scenario scenario;
  scenario.rig.height_m = 0.4;
  scenario.rig.pitch_down_rad = 0.05;
  scenario.world.balls = {{{1.0, 0.0, 0.2}, 0.06, 3}};
  return scenario;
}

Eigen::Vector3d in_left_camera(const Scenario& made, const slam::Pose& pose, const Ball& ball) {
  const Eigen::Isometry3d world_from_robot(Eigen::AngleAxisd(pose.heading_rad, Eigen::Vector3d::UnitZ()));
  return vision::robot_from_camera(made.rig).inverse() * (world_from_robot.inverse() * ball.centre_m);
}

// Every ball is there to be seen from one of the looks, above the floor, apart from all others; and every
// look shows some. Mutations: a look's heading left out, or half a radian off; the right camera's view, the
// floor or the room between balls not asked for.
TEST(CalibrationScene, ShowsEachBallToBothCamerasInSomeLook) {
  const Scenario scenario = cameras();
  const CalibrationDepths depths = measurable_depths(scenario.rig, 0.06, 5.0);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Scenario made = calibration_scene(scenario, {depths}, seed);
    ASSERT_EQ(made.path.size(), 6U);
    ASSERT_GT(made.world.balls.size(), 40U);
    std::array<int, 6> shown{};
    for (const Ball& ball : made.world.balls) {
      int looks = 0;
      for (std::size_t look = 0; look < shown.size(); ++look) {
        const Eigen::Vector3d left = in_left_camera(made, made.path[look].pose, ball);
        if (left.z() < depths.nearest_m - 1e-9 || left.z() > depths.farthest_m + 1e-9) continue;
        const Eigen::Vector3d right = vision::camera_point(made.rig, left, vision::Side::kRight);
        const bool in_both = vision::project_if_visible(made.rig.intrinsics, left) &&
                             vision::project_if_visible(made.rig.intrinsics, right);
        shown[look] += in_both ? 1 : 0;
        looks += in_both ? 1 : 0;
      }
      EXPECT_GE(looks, 1) << seed;
      EXPECT_GE(ball.centre_m.z(), ball.radius_m);
      EXPECT_EQ(ball.radius_m, 0.06);
      for (const Ball& other : made.world.balls) {
        if (&other != &ball) {
          EXPECT_GT((other.centre_m - ball.centre_m).norm(), 2.0 * ball.radius_m);
        }
      }
    }
    EXPECT_GE(*std::ranges::min_element(shown), 5);
  }
}

// Of n balls whose logarithms of depth are uniform a quarter lies in each quarter, to 4 sqrt(3 n / 16); what
// does not fit between others, or would lie below the floor, takes some of the near ones away.
TEST(CalibrationScene, SpreadsBallsEvenlyOverTheLogarithmOfDepth) {
  const Scenario scenario = cameras();
  const CalibrationDepths depths = measurable_depths(scenario.rig, 0.06, 5.0);
  std::array<int, 4> quarters{};
  int balls = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Scenario made = calibration_scene(scenario, {depths}, seed);
    for (const Ball& ball : made.world.balls) {
      const double depth = ball.centre_m.head<2>().norm();
      const double share =
          std::log(depth / depths.nearest_m) / std::log(depths.farthest_m / depths.nearest_m);
      ++quarters[static_cast<std::size_t>(std::clamp(share * 4.0, 0.0, 3.0))];
      ++balls;
    }
  }
  for (const int quarter : quarters)
    EXPECT_NEAR(quarter, balls / 4.0, 0.2 * balls / 4.0 + 4.0 * std::sqrt(3.0 * balls / 16.0));
}

TEST(CalibrationScene, IsTheSameForTheSameSeedAndAnotherForAnother) {
  const Scenario scenario = cameras();
  const CalibrationDepths depths = measurable_depths(scenario.rig, 0.06, 5.0);
  const World a = calibration_scene(scenario, {depths}, 3).world;
  const World b = calibration_scene(scenario, {depths}, 3).world;
  const World c = calibration_scene(scenario, {depths}, 4).world;
  ASSERT_EQ(a.balls.size(), b.balls.size());
  for (std::size_t i = 0; i < a.balls.size(); ++i) EXPECT_EQ(a.balls[i].centre_m, b.balls[i].centre_m);
  EXPECT_NE(a.balls[0].centre_m, c.balls[0].centre_m);
  EXPECT_NE(a.light.towards_light, c.light.towards_light);
  const World plain = calibration_scene(scenario, {depths, true}, 3).world;
  EXPECT_EQ(plain.floor, Material::kPlain);
  EXPECT_EQ(plain.light.towards_light, a.light.towards_light);
  EXPECT_EQ(plain.balls.back().centre_m, a.balls.back().centre_m);
}

}  // namespace
}  // namespace stereobench::worlds
