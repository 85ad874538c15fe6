/// Mesh files in worlds: they hide balls, keep balls and clutter out, and are read for those alone who ask.
#include "worlds/visibility/occluders.h"

#include <array>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/worlds/generate/random_circle.h"
#include "tests/worlds/scenario/read_scenario.h"
#include "tests/worlds/scenario/scenario_text.h"
#include "tests/worlds/visibility/obj_solids.h"
#include "tests/worlds/visibility/views.h"
#include "worlds/visibility/visibility.h"

namespace stereobench::worlds {
namespace {

/// Walls of 2.5 m that are boxes, each a cube that is stretched and turned.
struct Box {
  Eigen::Vector2d middle_m;
  Eigen::Vector2d size_m;
  double heading_deg = 0.0;
};

/// Rooms around a drive in a circle.
const std::vector<Box> kBoxes = {{{3.5, 0.0}, {0.1, 3.0}, 20.0},
                                 {{0.0, 4.0}, {4.0, 0.2}, -10.0},
                                 {{-3.6, -0.5}, {0.3, 2.5}, 45.0},
                                 {{1.0, -4.5}, {3.0, 0.05}, 5.0}};

std::string lines_of(const std::vector<Box>& boxes) {
  std::string lines;
  for (const Box& box : boxes) {
    std::ostringstream line;
    line << "    - {file: cube.obj, at_m: [" << box.middle_m.x() << ", " << box.middle_m.y()
         << ", 0], scale: [" << box.size_m.x() << ", " << box.size_m.y()
         << ", 2.5], heading_deg: " << box.heading_deg << "}\n";
    lines += line.str();
  }
  return lines;
}

/// The same boxes as four walls each.
std::vector<Wall> walls_of(const std::vector<Box>& boxes) {
  std::vector<Wall> walls;
  for (const Box& box : boxes) {
    std::array<Eigen::Vector2d, 4> corners;
    for (std::size_t i = 0; i < 4; ++i) {
      const Eigen::Vector2d unit(i == 0 || i == 3 ? -0.5 : 0.5, i < 2 ? -0.5 : 0.5);
      corners[i] = box.middle_m +
                   Eigen::Rotation2Dd(box.heading_deg * M_PI / 180.0) * unit.cwiseProduct(box.size_m).eval();
    }
    for (std::size_t i = 0; i < 4; ++i) walls.push_back({corners[i], corners[(i + 1) % 4]});
  }
  return walls;
}

/// A drive in a circle, and a world of boxes with what else it has.
std::string scenario_among(const std::vector<Box>& boxes, const std::string& rest) {
  return R"(name: boxes
sensor: stereo
identity: colour_class
colour_spacing_m: 2
rig: {width_px: 1024, height_px: 768, focal_px: 887, baseline_m: 0.12, height_m: 0.4}
odometry_noise: {v_per_v: 0.1}
placement_jitter_m: 0.02
path: {kind: circle, start_m: [0, -1.5], radius_m: 1.5, speed_mps: 0.3, step_s: 1}
world:
  ball_radius_m: 0.1
  meshes:
)" + lines_of(boxes) +
         rest;
}

std::string generator(int seed) {
  return "  generator: {kind: ball_field, balls: 12, low_m: [-6, -6], high_m: [6, 6], balls_in_view: 2, "
         "seed: " +
         std::to_string(seed) + "}\n";
}

class Occluders : public testing::Test {
 protected:
  void SetUp() override { folder_.write("cube.obj", kCube); }
  std::filesystem::path write(const std::string& text) const { return folder_.write("boxes.yaml", text); }

 private:
  ScenarioFolder folder_;
};

// The other check knows no meshes: it is shown the boxes as walls.
TEST_F(Occluders, GeneratedBallsStandClearOfThemAndEnoughAreInView) {
  for (int seed = 0; seed < 5; ++seed) {
    const Scenario scenario = read_scenario(write(scenario_among(kBoxes, generator(seed))), {}, obj_solid);
    for (const std::uint64_t jitter : {1U, 2U, 3U}) {
      World world = world_for_seed(scenario, jitter);
      world.walls = walls_of(kBoxes);
      EXPECT_GE(std::ranges::min(views_of(scenario, world, 17.7).balls_in_view), 2) << seed;
      for (const Ball& ball : world.balls)
        for (const Wall& wall : world.walls)
          EXPECT_GT(distance_m(ball.centre_m.head<2>(), wall), ball.radius_m) << seed;
    }
  }
}

// Mutation: a place judged by the surfaces near it alone.
TEST_F(Occluders, NoBallIsPutIntoABlock) {
  const std::vector<Box> blocks = {{{4.0, 0.0}, {3.6, 10.0}}, {{-4.0, 0.0}, {3.6, 10.0}}};
  const Scenario scenario = read_scenario(write(scenario_among(blocks, generator(0))), {}, obj_solid);
  for (const Ball& ball : scenario.world.balls)
    EXPECT_TRUE(std::abs(std::abs(ball.centre_m.x()) - 4.0) > 1.8 || std::abs(ball.centre_m.y()) > 5.0)
        << ball.centre_m.transpose();
  EXPECT_GE(scenario.world.balls.size(), 12U);
}

/// Balls on a lattice around the drive, none in a wall.
std::vector<Ball> lattice(const std::vector<Wall>& walls) {
  std::vector<Ball> balls;
  for (int i = 0; i < 144; ++i) {
    const Eigen::Vector2d at(1.1 * (i % 12) - 5.9, 1.1 * (i / 12) - 6.1);
    if (std::ranges::all_of(walls, [&](const Wall& wall) { return distance_m(at, wall) > 0.15; }))
      balls.push_back({{at.x(), at.y(), 0.1}, 0.1, 0});
  }
  return balls;
}

TEST_F(Occluders, BoxesHideWhatWallsInTheirPlacesHide) {
  Scenario scenario = read_scenario(write(scenario_among(kBoxes, generator(3))), {}, obj_solid);
  World bare = scenario.world;
  bare.meshes.clear();
  bare.balls = scenario.world.balls = lattice(walls_of(kBoxes));
  World walled = bare;
  walled.walls = walls_of(kBoxes);
  std::size_t in_view = 0, hidden = 0, rims = 0;
  for (const PathStep& step : scenario.path) {
    const std::vector<int> by_boxes = balls_in_view(scenario, scenario.world, step.pose);
    const std::vector<int> by_walls = balls_in_view(scenario, walled, step.pose);
    EXPECT_TRUE(std::ranges::includes(by_boxes, by_walls));
    in_view += by_boxes.size();
    rims += by_boxes.size() - by_walls.size();  // of which a wall may hide nothing
    hidden += balls_in_view(scenario, bare, step.pose).size() - by_boxes.size();
  }
  EXPECT_GT(in_view, 100U);
  EXPECT_GT(hidden, 30U);
  EXPECT_LE(rims, in_view / 20);
}

// The fence leaves 0.8 m beside the drive, and things are tried for up to 3 m from it.
TEST_F(Occluders, ThingsAreStrewnClearOfThemAndOnTheDrivesSide) {
  const std::vector<Box> fence = {{{2.4, 0.0}, {0.2, 5.0}},
                                  {{-2.4, 0.0}, {0.2, 5.0}},
                                  {{0.0, 2.4}, {5.0, 0.2}},
                                  {{0.0, -2.4}, {5.0, 0.2}}};
  const Scenario scenario = read_scenario(
      write(scenario_among(fence, "  balls: [{colour: 0, at_m: [0, 0, 0.1]}]\n")),
      {"randomise={clutter: {count: 9, size_m: [0.1, 0.3], range_m: [0.4, 3], clearance_m: 0.2}}"},
      obj_solid);
  std::size_t scattered = 0, beside_fence = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    for (const MeshInstance& mesh : world_for_seed(scenario, seed).meshes) {
      if (mesh.shape == MeshShape::kFile) continue;
      const double out_m = mesh.position_m.head<2>().lpNorm<Eigen::Infinity>();
      EXPECT_LT(out_m + 0.5 * mesh.scale.head<2>().minCoeff(), 2.3) << seed;
      ++scattered;
      beside_fence += out_m > 1.7 ? 1 : 0;
    }
  }
  EXPECT_GE(scattered, 40U);
  EXPECT_GE(beside_fence, 5U) << "too far from it";
}

// A column reaches up to the ball on it and hides it from none but those below.
TEST_F(Occluders, ABallIsSeenOnWhatCarriesIt) {
  const Scenario& scenario = everything();
  World bare = scenario.world;
  bare.meshes.clear();
  std::size_t with = 0, without = 0;
  for (const std::uint64_t seed : {1U, 2U}) {
    World world = scenario.world;
    for (Ball& ball : world.balls) ball.centre_m.x() += 0.01 * static_cast<double>(seed);
    for (MeshInstance& mesh : world.meshes) mesh.position_m.x() += 0.01 * static_cast<double>(seed);
    bare.balls = world.balls;
    for (const PathStep& step : scenario.path) {
      with += balls_in_view(scenario, world, step.pose).size();
      without += balls_in_view(scenario, bare, step.pose).size();
    }
  }
  EXPECT_LE(with, without);
  EXPECT_GE(with, 0.9 * static_cast<double>(without));
}

/// How often mesh files are asked for while a scenario is read.
int times_asked(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  int asked = 0;
  read_scenario(file, overrides, [&](const World& world, const MeshInstance& mesh) {
    ++asked;
    return obj_solid(world, mesh);
  });
  return asked;
}

TEST_F(Occluders, AreReadForThoseAloneWhoAsk) {
  const auto plain = write(scenario_among(kBoxes, "  balls: [{colour: 0, at_m: [0, 0, 0.1]}]\n"));
  EXPECT_EQ(times_asked(plain, {}), 0);
  EXPECT_EQ(times_asked(plain, {"randomise={light: {}, walls: {}, ball_colours: {}}"}), 0);
  EXPECT_EQ(times_asked(plain, {"randomise={clutter: {}}"}), 4);
  EXPECT_EQ(times_asked(plain, {"randomise={distractors: {}}"}), 4);
  EXPECT_EQ(times_asked(plain, {"randomise={clutter: {}}", "world.meshes=[]"}), 0);
  EXPECT_EQ(times_asked(write(scenario_among(kBoxes, generator(0))), {}), 4);
}

TEST_F(Occluders, NobodyLooksThroughAMeshThatWasNotRead) {
  const auto file = write(scenario_among(kBoxes, "  balls: [{colour: 0, at_m: [0, 1, 0.1]}]\n"));
  const Scenario scenario = read_scenario(file);
  EXPECT_THROW(balls_in_view(scenario, scenario.world, {0.0, 0.0, 1.57}), std::invalid_argument);
  EXPECT_THROW(read_scenario(file, {"randomise={clutter: {}}"}), std::invalid_argument);
}

}  // namespace
}  // namespace stereobench::worlds
