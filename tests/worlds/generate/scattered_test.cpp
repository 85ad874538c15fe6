/// Laws of what is scattered beside a drive.
#include "worlds/generate/scattered.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/worlds/generate/random_circle.h"
#include "tests/worlds/visibility/views.h"
#include "worlds/generate/paint.h"
#include "worlds/generate/randomise.h"

namespace stereobench::worlds {
namespace {

/// Whether a ray from a camera to a point meets a box, by its slabs.
bool meets(const MeshInstance& box, const Eigen::Vector3d& camera, const Eigen::Vector3d& point) {
  const Eigen::AngleAxisd back(-box.heading_rad, Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d from = back * (camera - box.position_m);
  const Eigen::Vector3d way = back * (point - camera);
  const Eigen::Vector3d low(-0.5 * box.scale.x(), -0.5 * box.scale.y(), 0.0);
  const Eigen::Vector3d high(0.5 * box.scale.x(), 0.5 * box.scale.y(), box.scale.z());
  double begin = 0.0, end = 1.0;
  for (int i = 0; i < 3; ++i) {
    const double a = (low[i] - from[i]) / way[i], b = (high[i] - from[i]) / way[i];
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
  return begin < end;
}

/// Whether a thing stands before a ball: rays to its outline and middle, as it is seen from the camera.
bool is_hidden(const World& world, const Ball& ball, const Eigen::Vector2d& camera_m, double height_m) {
  const Eigen::Vector3d camera(camera_m.x(), camera_m.y(), height_m);
  const Eigen::Vector3d sight = (ball.centre_m - camera).normalized();
  const Eigen::Vector3d side = sight.unitOrthogonal();
  for (int k = 0; k < 24; ++k) {
    const Eigen::Vector3d rim = Eigen::AngleAxisd(k * M_PI / 12.0, sight) * side * (0.99 * ball.radius_m);
    for (const MeshInstance& mesh : world.meshes)
      if (mesh.shape != MeshShape::kFile && meets(mesh, camera, ball.centre_m + rim)) return true;
  }
  return false;
}

class Scattered : public testing::TestWithParam<std::uint64_t> {};

// Mutation: balls_in_view not asked. Not caught: what is hidden not taken off the list; the spheres around
// things are so generous that several together never hide too much here.
TEST_P(Scattered, ThingsLeaveEnoughBallsInViewAtEachStep) {
  static const Scenario scenario =
      scenario_with("randomise={clutter: {count: 14}, distractors: {}, balls_in_view: 1}");
  const World world = world_for_seed(scenario, GetParam());
  World bare = world;
  bare.meshes.resize(scenario.world.meshes.size());
  int hidden = 0;
  for (const PathStep& step : scenario.path) {
    std::array<std::vector<bool>, 2> whole;
    std::array<Eigen::Vector2d, 2> cameras;
    for (const std::size_t side : {0U, 1U}) {
      const double left_m = (side == 0 ? 0.5 : -0.5) * scenario.rig.baseline_m;
      cameras[side] = camera_in_world(step.pose, left_m);
      whole[side] = whole_in_camera(scenario, bare, step.pose, left_m);
    }
    int before = 0, left = 0;
    for (std::size_t i = 0; i < world.balls.size(); ++i) {
      if (!whole[0][i] || !whole[1][i]) continue;
      ++before;
      const auto hides_it = [&](const Eigen::Vector2d& camera) {
        return is_hidden(world, world.balls[i], camera, scenario.rig.height_m);
      };
      if (!hides_it(cameras[0]) && !hides_it(cameras[1])) ++left;
    }
    EXPECT_GE(left, std::min(before, scenario.randomise.balls_in_view));
    hidden += before - left;
  }
  RecordProperty("hidden", hidden);
}

// Mutations: no clearance; walls not looked at.
TEST_P(Scattered, ThingsStandClearOfDriveWallsBallsAndEachOther) {
  const Scenario& scenario = everything();
  const World world = world_for_seed(scenario, GetParam());
  std::vector<std::vector<Eigen::Vector2d>> outlines;
  for (const MeshInstance& mesh : world.meshes) {
    if (mesh.shape == MeshShape::kFile) continue;
    EXPECT_EQ(mesh.carried_ball, slam::kUnknown);
    EXPECT_EQ(mesh.position_m.z(), 0.0);
    std::vector<Eigen::Vector2d> outline;
    for (int k = 0; k < 40; ++k) {
      const double turn = k * M_PI / 20.0;
      Eigen::Vector2d rim(std::cos(turn), std::sin(turn));
      if (mesh.shape == MeshShape::kBox) rim /= rim.lpNorm<Eigen::Infinity>();
      outline.emplace_back(mesh.position_m.head<2>() + Eigen::Rotation2Dd(mesh.heading_rad) *
                                                           (0.5 * mesh.scale.head<2>().cwiseProduct(rim)));
    }
    outlines.push_back(std::move(outline));
  }
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    for (const Eigen::Vector2d& at : outlines[i]) {
      EXPECT_TRUE(std::abs(at.x()) < 3.0 && at.y() > -2.0 && at.y() < 4.0) << "outside of the room";
      EXPECT_GT(std::abs((at - Eigen::Vector2d(0.0, 1.0)).norm() - 1.0), 0.395) << "in the way";
      for (const Ball& ball : world.balls) EXPECT_GT((at - ball.centre_m.head<2>()).norm(), ball.radius_m);
      for (std::size_t k = 0; k < i; ++k)
        for (const Eigen::Vector2d& other : outlines[k]) EXPECT_GT((at - other).norm(), 0.0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Scattered, testing::Range(std::uint64_t{0}, std::uint64_t{12}));

TEST(ScatteredThings, NoDistractorIsALandmarkAndAllAreNearAColourOfThePalette) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const SeedWorld made = seed_world(scenario_with("randomise={distractors: {count: 3, shade: 1}}"), seed);
    ASSERT_EQ(made.world.balls.size(), everything().world.balls.size());
    ASSERT_EQ(made.world.meshes.size() + made.left_out.size(), everything().world.meshes.size() + 3);
    for (std::size_t i = everything().world.meshes.size(); i < made.world.meshes.size(); ++i) {
      double nearest = 1.0;
      for (int colour = 0; colour < 18; ++colour)
        nearest = std::min(nearest,
                           (made.world.meshes[i].tint_rgb - palette_rgb(colour)).lpNorm<Eigen::Infinity>());
      EXPECT_LE(nearest, 0.1);
    }
  }
}

// What finds no room is left out, by name, and ends nothing.
TEST(ScatteredThings, LeavesOutWhatFindsNoRoom) {
  const SeedWorld made = seed_world(scenario_with("randomise={clutter: {count: 2, size_m: 8}}"), 0);
  EXPECT_THAT(made.left_out, testing::ElementsAre("clutter[0]", "clutter[1]"));
  EXPECT_EQ(made.world.meshes.size(), everything().world.meshes.size());
}

}  // namespace
}  // namespace stereobench::worlds
