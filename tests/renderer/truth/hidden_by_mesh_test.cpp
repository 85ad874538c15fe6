/// What worlds say that mesh files hide, against what rendered pictures show of the balls.
#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "renderer/renderer.h"
#include "renderer/surfaces/mesh_cache.h"
#include "renderer/truth/ball_truth.h"
#include "tests/renderer/folder.h"
#include "tests/renderer/random_scene.h"
#include "tests/worlds/scenario/read_scenario.h"
#include "worlds/visibility/visibility.h"

namespace stereobench::renderer {
namespace {

using test::between;
using vision::Side;

/// Which share of each ball the camera sees that sees less of it; none of those outside of a picture.
std::map<int, double> shares_seen(Renderer& renderer, const worlds::World& world,
                                  const vision::StereoRig& rig, const slam::Pose& pose) {
  const StereoFrame frame = renderer.render(pose);
  std::map<int, double> shares;
  std::map<int, int> cameras;
  for (const auto& [side, seen] :
       {std::pair(Side::kLeft, &frame.left), std::pair(Side::kRight, &frame.right)}) {
    for (const BallTruth& truth : ball_truths(world, camera_view(rig, side, pose), seen->ball_id)) {
      if (truth.truncated || truth.px_count_all == 0) continue;
      const double share = std::min(truth.visib_fract, cameras[truth.ball] > 0 ? shares[truth.ball] : 1.0);
      shares[truth.ball] = share;
      ++cameras[truth.ball];
    }
  }
  std::erase_if(shares, [&](const auto& entry) { return cameras[entry.first] < 2; });
  return shares;
}

/// Panels and splinters of all directions around the middle, in a file of another unit and another up.
std::string splinters(std::uint64_t seed) {
  slam::RandomStream random(seed, slam::Stream::kWorld, 5);
  std::ostringstream obj;
  for (int i = 0; i < 60; ++i) {
    const double angle = between(random, -M_PI, M_PI), away = between(random, 60.0, 350.0);
    const Eigen::Vector3d middle(away * std::cos(angle), between(random, 0.0, 60.0), away * std::sin(angle));
    for (int corner = 0; corner < 3; ++corner)
      obj << "v " << middle.x() + between(random, -40.0, 40.0) << " "
          << middle.y() + between(random, -40.0, 40.0) << " " << middle.z() + between(random, -40.0, 40.0)
          << "\n";
    obj << "f -3 -2 -1\n";
  }
  return test::folder_of_this_process().write("splinters_" + std::to_string(seed) + ".obj", obj.str());
}

worlds::Scenario splintered_room(std::uint64_t seed) {
  worlds::Scenario scenario;
  scenario.world = test::random_room(seed);
  scenario.rig = test::small_rig();
  scenario.world.meshes.push_back({.file = splinters(seed),
                                   .position_m = {0.2, -0.1, 0.05},
                                   .heading_rad = 0.7,
                                   .scale = {1.0, 1.2, 0.9},
                                   .roll_rad = 0.1,
                                   .pitch_rad = -0.2,
                                   .unit_m = 0.01,
                                   .up = worlds::MeshUp::kY});
  MeshCache cache;
  worlds::give_occluders(scenario.world, cache.occluders());
  return scenario;
}

TEST(HiddenByMesh, SightAgreesWithWhatPicturesShow) {
  int in_view = 0, hidden = 0, unseen_hiders = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const worlds::Scenario scenario = splintered_room(seed);
    worlds::World bare = scenario.world;
    bare.meshes.clear();
    Renderer renderer(scenario.world, scenario.rig);
    slam::Pose pose = test::random_pose(seed);
    for (int k = 0; k < 6; ++k) {
      pose.heading_rad += 1.0;
      const std::vector<int> seen = worlds::balls_in_view(scenario, scenario.world, pose);
      std::map<int, double> shares = shares_seen(renderer, scenario.world, scenario.rig, pose);
      for (const int ball : worlds::balls_in_view(scenario, bare, pose)) {
        ASSERT_TRUE(shares.contains(ball)) << seed;
        if (std::ranges::binary_search(seen, ball)) {
          EXPECT_GE(shares[ball], 0.9) << seed << " " << k << ", ball " << ball;
          ++in_view;
        } else {
          unseen_hiders += shares[ball] == 1.0 ? 1 : 0;  // splinters thinner than a pixel
          ++hidden;
        }
      }
    }
  }
  EXPECT_GE(in_view, 60);
  EXPECT_GE(hidden, 40);
  EXPECT_LE(unseen_hiders, hidden / 20);
}

std::string scenario_in(const std::string& mesh, const std::string& path, const std::string& field) {
  return R"(name: meshed
sensor: stereo
identity: colour_class
rig: {width_px: 512, height_px: 384, focal_px: 443, baseline_m: 0.12, height_m: 0.4}
odometry_noise: {v_per_v: 0.1}
path: )" +
         path + "\nworld:\n  ball_radius_m: 0.1\n  meshes: [" + mesh +
         "]\n  generator: {kind: ball_field, balls: 5, balls_in_view: 2, clearance_m: 0.1, " + field + "}\n";
}

/// Expects two balls at least in each of some pictures along the drive.
void expect_two_in_pictures(const std::string& text, std::size_t pictures) {
  const test::Folder folder;
  MeshCache cache;
  const worlds::Scenario scenario =
      worlds::read_scenario(folder.write("meshed.yaml", text), {}, cache.occluders());
  Renderer renderer(scenario.world, scenario.rig);
  for (std::size_t i = 0; i < pictures; ++i) {
    const slam::Pose& pose = scenario.path[i * scenario.path.size() / pictures].pose;
    std::map<int, double> shares = shares_seen(renderer, scenario.world, scenario.rig, pose);
    const auto whole = std::ranges::count_if(shares, [](const auto& entry) { return entry.second >= 0.9; });
    EXPECT_GE(whole, 2) << "at (" << pose.x_m << ", " << pose.y_m << ")";
  }
}

/// A room with a wall half through it, and a floor.
const std::string kRoom =
    "v 0 0 0\nv 5 0 0\nv 5 4 0\nv 0 4 0\nv 0 0 2\nv 5 0 2\nv 5 4 2\nv 0 4 2\nv 2.5 0 0\nv 2.5 2 0\nv 2.5 2 "
    "2\n"
    "v 2.5 0 2\nf 1 2 3 4\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nf 9 10 11 12\n";

TEST(HiddenByMesh, GeneratedBallsAreInThePicturesOfARoom) {
  const std::string file = test::folder_of_this_process().write("room.obj", kRoom);
  expect_two_in_pictures(
      scenario_in("{file: " + file + ", at_m: [10, 20, 0], scale: [1.6, 1.5, 1]}",
                  "{kind: spline, points_m: [[11.5, 22], [12, 24.3], [14, 24.9], [15.5, 24.3]], "
                  "speed_mps: 0.5, step_s: 0.5}",
                  "low_m: [10, 20], high_m: [18, 26]"),
      12);
}

TEST(HiddenByMesh, GeneratedBallsAreInThePicturesOfABuilding) {
  const std::filesystem::path file =
      STEREOBENCH_SOURCE_DIR "/../shared/data/meshes/worlds/willowgarage/meshes/willowgarage_visual.dae";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  expect_two_in_pictures(
      scenario_in(
          "{file: " + file.string() + ", at_m: [0, 0, 0], up: y}",
          "{kind: spline, points_m: [[9, 24], [12, 29], [17, 33], [20, 28]], speed_mps: 1, step_s: 0.5}",
          "low_m: [5, 20], high_m: [25, 38]"),
      10);
}

TEST(MeshCache, ReadsAFileOnceAndAgainWhereLimitsAreOthers) {
  worlds::World world;
  {
    const test::Folder folder;
    world.meshes.push_back({.file = folder.write("room.obj", kRoom)});
    world.meshes.push_back(world.meshes.front());
  }
  MeshCache cache;
  EXPECT_THROW(worlds::give_occluders(world, cache.occluders()), std::runtime_error);
  const test::Folder folder;
  for (worlds::MeshInstance& mesh : world.meshes) mesh.file = folder.write("room.obj", kRoom);
  worlds::give_occluders(world, cache.occluders());
  EXPECT_EQ(world.meshes[0].occluder, world.meshes[1].occluder);
  std::filesystem::remove(world.meshes[0].file);
  EXPECT_EQ(place_meshes(world, cache.forms()).vertices.size(), 2U * 12U * 3U);
  world.mesh_limits.triangles = 5;
  EXPECT_THROW(place_meshes(world, cache.forms()), std::runtime_error);
}

}  // namespace
}  // namespace stereobench::renderer
