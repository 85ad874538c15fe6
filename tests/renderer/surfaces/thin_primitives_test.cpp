/// Truth of columns whose primitives are seen at a slant, or are thinner than a pixel: matches agree with
/// ranges, and what is closed stays closed.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "renderer/camera/lens.h"
#include "renderer/renderer.h"
#include "renderer/truth/correspondence.h"
#include "renderer/truth/distorted_ids.h"
#include "renderer/truth/pixel_truth.h"
#include "tests/renderer/folder.h"
#include "tests/renderer/random_scene.h"
#include "vision/camera/distortion.h"
#include "vision/camera/rig.h"

namespace stereobench::renderer {
namespace {

/// A closed column of many sides, 1 m high, its sides cut into bands; turned so that no side is special.
std::string column_file(int sides, int bands) {
  std::string text;
  for (int band = 0; band <= bands; ++band)
    for (int side = 0; side < sides; ++side) {
      const double angle = 2.0 * M_PI * side / sides + 0.1234;
      text += "v " + std::to_string(std::cos(angle)) + " " + std::to_string(std::sin(angle)) + " " +
              std::to_string(static_cast<double>(band) / bands) + "\n";
    }
  for (int band = 0; band < bands; ++band)
    for (int side = 0; side < sides; ++side) {
      const int a = band * sides + side + 1, b = band * sides + (side + 1) % sides + 1;
      text += "f " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(b + sides) + " " +
              std::to_string(a + sides) + "\n";
    }
  text += "f";
  for (int side = 0; side < sides; ++side) text += " " + std::to_string(bands * sides + side + 1);
  return test::folder_of_this_process().write(
      "column_" + std::to_string(sides) + "_" + std::to_string(bands) + ".obj", text + "\n");
}

/// Columns in a room, seen by both cameras.
struct ColumnRoom {
  ColumnRoom(std::uint64_t seed, bool has_lens) : world(with_columns(seed)), scene(world) {
    slam::RandomStream random(seed, slam::Stream::kOdometry);
    const slam::Pose pose{0.2 * random.uniform(), 0.2 * random.uniform(), 0.3 * random.uniform() - 0.15};
    if (has_lens) {
      rig.distortion = {.k1 = -0.25, .k2 = 0.08, .p1 = 0.001};
      const StereoIdBuffers undistorted = Renderer(world, pinhole_rig_of(rig)).id_buffers(pose, pose);
      left = distorted_ids(scene, undistorted.left, rig);
      right = distorted_ids(scene, undistorted.right, rig);
    } else {
      const StereoIdBuffers ids = Renderer(world, rig).id_buffers(pose, pose);
      left = ids.left;
      right = ids.right;
    }
  }

  static worlds::World with_columns(std::uint64_t seed) {
    worlds::World world = test::random_room(seed);
    slam::RandomStream random(seed, slam::Stream::kClutter);
    for (const auto& [sides, bands] : {std::pair{400, 1}, {60, 3}, {24, 40}, {100, 30}}) {
      const double along = test::between(random, 1.0, 3.5), aside = test::between(random, -0.4, 0.4) * along;
      const double radius = test::between(random, 0.03, 0.2);
      world.meshes.push_back({.file = column_file(sides, bands),
                              .position_m = {along, aside, 0.0},
                              .scale = {radius, radius, test::between(random, 0.5, 2.0)},
                              .material = worlds::Material::kPlain});
    }
    return world;
  }

  worlds::World world;
  SceneGeometry scene;
  vision::StereoRig rig = test::small_rig();
  IdBuffer left, right;
};

class ThinPrimitives : public testing::TestWithParam<std::tuple<std::uint64_t, bool>> {};

// A pixel's ray and range say where its point is, and that where the other camera sees it. Red before: shifts
// of another point, the primitive's nearest one, where the ray passes by its primitive (up to px behind a
// lens).
TEST_P(ThinPrimitives, ShiftsAreThoseOfThePixelsOwnRange) {
  const auto [seed, has_lens] = GetParam();
  const ColumnRoom room(seed, has_lens);
  const Correspondence found = correspond(room.scene, room.left, room.right);
  const PixelTruth truth = pixel_truth(room.scene, room.left);
  const PixelRays lines(room.left.view);
  double worst_px = 0.0;
  int compared = 0;
  for (int v = 0; v < found.occlusion.rows; ++v) {
    for (int u = 0; u < found.occlusion.cols; ++u) {
      if (found.occlusion.at<std::uint8_t>(v, u) < static_cast<std::uint8_t>(Occlusion::kHidden)) continue;
      const Ray line = lines(u, v);
      const Eigen::Vector3d point =
          line.origin_m + double{truth.range_m.at<float>(v, u)} * line.direction.normalized();
      const Eigen::Vector2d there = shown_at(room.right.view, room.right.view.camera_from_world * point);
      const cv::Vec2f shift = found.shift_px.at<cv::Vec2f>(v, u);
      const Eigen::Vector2d said(u + double{shift[0]}, v + double{shift[1]});
      worst_px = std::max(worst_px, (said - there).norm());
      ++compared;
    }
  }
  EXPECT_LE(worst_px, 0.001);
  EXPECT_GT(compared, 50000);
}

// Of pixels that see a wall or the floor, those that count as seen have a line to the other camera that no
// primitive of a column cuts: all primitives are asked. Red before: primitives that none of four pixels sees.
TEST_P(ThinPrimitives, HideWhatIsBehindClosedMeshes) {
  const auto [seed, has_lens] = GetParam();
  const ColumnRoom room(seed, has_lens);
  const Correspondence found = correspond(room.scene, room.left, room.right);
  const PixelRays lines(room.left.view);
  const Eigen::Vector3d camera_m = room.right.view.centre_in_world();
  const int first = first_mesh_primitive(room.world);
  const int last = first + 2 * (400 + 180 + 960 + 3000) + 398 + 58 + 22 + 98;
  int open = 0, hidden = 0;
  for (int v = 0; v < found.occlusion.rows; v += 12) {
    for (int u = 0; u < found.occlusion.cols; ++u) {
      const int primitive = room.left.primitive.at<int>(v, u);
      const auto occlusion = static_cast<Occlusion>(found.occlusion.at<std::uint8_t>(v, u));
      hidden += occlusion == Occlusion::kHidden ? 1 : 0;
      if (primitive >= first || occlusion != Occlusion::kSeen) continue;
      const Eigen::Vector3d point = room.scene.seen(primitive, lines(u, v)).on_primitive;
      const Ray line{camera_m, point - camera_m};
      bool cut = false;
      for (int other = first; other < last && !cut; ++other) cut = room.scene.enter(other, line) < 1.0 - 1e-9;
      open += cut ? 1 : 0;
    }
  }
  EXPECT_EQ(open, 0);
  EXPECT_GT(hidden, 30);
}

INSTANTIATE_TEST_SUITE_P(Rooms, ThinPrimitives,
                         testing::Combine(testing::Range(std::uint64_t{0}, std::uint64_t{2}),
                                          testing::Bool()));

}  // namespace
}  // namespace stereobench::renderer
