// A seed moves balls and makes them, each within its tolerance, and nothing else.
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "tests/worlds/scenario/read_scenario.h"
#include "tests/worlds/scenario/scenario_text.h"

namespace stereobench::worlds {
namespace {

Scenario read_small(const std::vector<std::string>& overrides = {}) {
  const ScenarioFolder folder;
  return read_scenario(folder.write("good.yaml", kSmallScenario), overrides);
}

TEST(WorldForSeed, WithoutJitterIsTheScenariosWorld) {
  const Scenario scenario = read_small({"placement_jitter_m=0"});
  const World world = world_for_seed(scenario, 5);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(world.balls[i].centre_m, scenario.world.balls[i].centre_m);
}

// Catches: jitter of one sign, of half the width, of both axes by one draw, of the height.
// 4000 draws of a uniform in +-j: the mean's sd is j / sqrt(3 x 4000), the correlation's 1 / sqrt(4000).
TEST(WorldForSeed, MovesEachBallUniformlyInTheFloorsPlane) {
  const Scenario scenario = read_small();
  const double jitter_m = scenario.placement_jitter_m;
  constexpr int kSeeds = 4000;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const Eigen::Vector3d moved =
        world_for_seed(scenario, seed).balls[1].centre_m - scenario.world.balls[1].centre_m;
    ASSERT_TRUE(moved.head<2>().cwiseAbs().maxCoeff() <= jitter_m * (1 + 1e-9));
    ASSERT_EQ(moved.z(), 0.0);
    const Eigen::Vector2d unit = moved.head<2>() / jitter_m;
    sum += unit;
    squares += unit * unit.transpose();
  }
  EXPECT_TRUE((sum / kSeeds).norm() < 4 * std::sqrt(2.0 / 3.0 / kSeeds));
  EXPECT_NEAR(squares(0, 0) / kSeeds, 1.0 / 3.0, 4 * std::sqrt(4.0 / 45.0 / kSeeds));
  EXPECT_NEAR(squares(1, 1) / kSeeds, 1.0 / 3.0, 4 * std::sqrt(4.0 / 45.0 / kSeeds));
  EXPECT_NEAR(squares(0, 1) * 3 / kSeeds, 0.0, 4 / std::sqrt(kSeeds));
}

// Catches: one stream for all balls, so that a new ball would move the others.
TEST(WorldForSeed, IsTheSameAgainAndEachBallIsOnItsOwn) {
  Scenario scenario = read_small();
  const World world = world_for_seed(scenario, 9);
  scenario.world.balls.push_back({{1, 1, 1}, 0.05, 4});
  const World with_one_more = world_for_seed(scenario, 9);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(world.balls[i].centre_m, with_one_more.balls[i].centre_m);
  EXPECT_NE(world.balls[0].centre_m, world_for_seed(scenario, 10).balls[0].centre_m);
}

// 3 x 2000 draws of a normal cut off at three deviations, whose variance is 0.9733: its square's mean has the
// sd 1.33 / sqrt(6000). Mutations: one stream for all balls; the ball's centre left where it was, in the
// floor.
TEST(WorldForSeed, MakesBallsWithinTheirTolerance) {
  const Scenario scenario = read_small({"placement_jitter_m=0", "world.ball_radius_sd_m=0.001"});
  constexpr int kSeeds = 2000;
  double squares = 0.0, product = 0.0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const World world = world_for_seed(scenario, seed);
    ASSERT_EQ(world.ball_radius_m(), 0.05) << "what detectors are told";
    for (std::size_t i = 0; i < 3; ++i) {
      const Ball &made = world.balls[i], &meant = scenario.world.balls[i];
      ASSERT_LE(std::abs(made.radius_m - meant.radius_m), 0.003);
      ASSERT_EQ(made.centre_m.z() - made.radius_m, meant.centre_m.z() - meant.radius_m) << "it stands";
      squares += std::pow((made.radius_m - 0.05) / 0.001, 2);
    }
    product += (world.balls[0].radius_m - 0.05) * (world.balls[1].radius_m - 0.05) / 1e-6;
  }
  EXPECT_NEAR(squares / (3 * kSeeds), 0.9733, 4.0 * 1.33 / std::sqrt(3.0 * kSeeds));
  EXPECT_NEAR(product / kSeeds, 0.0, 4.0 / std::sqrt(kSeeds));
  EXPECT_EQ(world_for_seed(scenario, 3).balls[2].radius_m, world_for_seed(scenario, 3).balls[2].radius_m);
}

TEST(WorldForSeed, LeavesBallsAloneThatSayTheirRadius) {
  const Scenario scenario = read_small({"world.ball_radius_sd_m=0.001", "world.balls[1].radius_m=0.0505"});
  const World world = world_for_seed(scenario, 4);
  EXPECT_NE(world.balls[0].radius_m, 0.05);
  EXPECT_EQ(world.balls[1].radius_m, 0.0505);
}

}  // namespace
}  // namespace stereobench::worlds
