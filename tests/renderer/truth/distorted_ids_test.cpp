/// Primitives, ranges, normals and shifts behind a lens, each pixel against the ray-caster along the ray that
/// the lens bends to it.

#include "renderer/truth/distorted_ids.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "renderer/camera/lens.h"
#include "renderer/renderer.h"
#include "renderer/truth/correspondence.h"
#include "renderer/truth/pixel_truth.h"
#include "tests/renderer/random_scene.h"
#include "tests/renderer/ray_caster.h"
#include "tests/renderer/wedge.h"
#include "vision/camera/distortion.h"
#include "vision/camera/rig.h"

namespace stereobench::renderer {
namespace {

using vision::Side;

/// A room with a mesh, behind lenses that bend lines by many pixels; the right camera is out of place.
struct DistortedRoom {
  explicit DistortedRoom(std::uint64_t seed)
      : world(test::random_room(seed)), triangles(test::add_wedge(world)), scene(world) {
    pose = seed % 2 == 0 ? slam::Pose{0.0, 0.0, 0.2} : test::random_pose(seed);
    rig.right_turn_rad = {0.004, -0.007, 0.011};
    rig.distortion = seed % 3 == 0 ? vision::Distortion{.k1 = 0.12, .k2 = 0.02, .p2 = -0.002}
                                   : vision::Distortion{.k1 = -0.25, .k2 = 0.08, .p1 = 0.001};
    const StereoIdBuffers undistorted = Renderer(world, pinhole_rig_of(rig)).id_buffers(pose, pose);
    left = distorted_ids(scene, undistorted.left, rig);
    right = distorted_ids(scene, undistorted.right, rig);
  }

  test::RayCaster caster(Side side) const {
    vision::StereoRig undistorted = rig;
    undistorted.distortion = {};
    test::RayCaster caster(world, undistorted, triangles);
    caster.stand_at(pose, side);
    return caster;
  }

  /// Where the ray-caster's pinhole has what a pixel shows.
  Eigen::Vector2d undistorted_place(double u, double v) const {
    return *vision::pinhole_point(rig, Eigen::Vector2d(u, v));
  }
  test::RayHit look(const test::RayCaster& caster, double u, double v) const {
    const Eigen::Vector2d place = undistorted_place(u, v);
    return caster.look(place.x(), place.y());
  }

  worlds::World world;
  std::vector<Triangle> triangles;
  SceneGeometry scene;
  vision::StereoRig rig = test::small_rig();
  slam::Pose pose;
  IdBuffer left, right;
};

/// The number of a triangle of the mesh is one of its surface's.
int surface_of(const DistortedRoom& room, const test::RayCaster& caster, const test::RayHit& ray) {
  return std::min(caster.primitive(ray.surface), first_mesh_primitive(room.world));
}

class BehindALens : public testing::TestWithParam<std::uint64_t> {};

// Mutations: a distorted picture of undistorted rays; the last primitive around that is met for the first.
TEST_P(BehindALens, EveryPixelHasWhatItsRayMeets) {
  const DistortedRoom room(GetParam());
  int others = 0, wrong_ranges = 0, wrong_normals = 0;
  for (const auto& [ids, side] : {std::pair(&room.left, Side::kLeft), std::pair(&room.right, Side::kRight)}) {
    const test::RayCaster caster = room.caster(side);
    const PixelTruth truth = pixel_truth(room.scene, *ids);
    for (int v = 0; v < truth.surface.rows; ++v) {
      for (int u = 0; u < truth.surface.cols; ++u) {
        const test::RayHit ray = room.look(caster, u, v);
        if (truth.surface.at<int>(v, u) != surface_of(room, caster, ray)) {
          ++others;
          continue;
        }
        const double truth_m = ray.surface == 0 ? ray.depth_m : caster.in_camera(ray.point_m).norm();
        const double range_m = double{truth.range_m.at<float>(v, u)};
        wrong_ranges += range_m == truth_m || std::abs(range_m - truth_m) <= 1e-6 * truth_m ? 0 : 1;
        const Eigen::Vector3d normal = Eigen::Vector3f(truth.normal.at<cv::Vec3f>(v, u).val).cast<double>();
        wrong_normals += (normal - ray.normal).norm() <= 1e-4 ? 0 : 1;
      }
    }
  }
  EXPECT_LE(others, 5);  // of 240,000: slivers that none of four pixels sees
  EXPECT_EQ(wrong_ranges, 0);
  EXPECT_EQ(wrong_normals, 0);
}

// Mutation: places in the other picture without its lens.
TEST_P(BehindALens, EveryPixelIsInTheOtherCameraWhereAnotherRaySaysItIs) {
  const DistortedRoom room(GetParam());
  const Correspondence found = correspond(room.scene, room.left, room.right);
  const test::RayCaster from = room.caster(Side::kLeft), to = room.caster(Side::kRight);
  int wrong_shifts = 0, wrong_fates = 0, hidden = 0, outside = 0;
  for (int v = 0; v < found.occlusion.rows; ++v) {
    for (int u = 0; u < found.occlusion.cols; ++u) {
      const test::RayHit ray = room.look(from, u, v);
      const auto occlusion = static_cast<Occlusion>(found.occlusion.at<std::uint8_t>(v, u));
      const int primitive = room.left.primitive.at<int>(v, u);
      if (std::min(primitive, first_mesh_primitive(room.world)) != surface_of(room, from, ray)) continue;
      if (ray.surface == 0) {
        wrong_fates += occlusion == Occlusion::kNothing ? 0 : 1;
        continue;
      }
      const Eigen::Vector3d point = to.in_camera(ray.point_m);
      const Eigen::Vector2d place = vision::image_point(room.rig, point);
      const bool is_inside = point.z() > 0.01 && vision::is_inside(room.rig.intrinsics, place);
      const Occlusion expected = !is_inside ? Occlusion::kOutside
                                 : room.look(to, place.x(), place.y()).depth_m < point.z() * (1.0 - 1e-7)
                                     ? Occlusion::kHidden
                                     : Occlusion::kSeen;
      wrong_fates += occlusion == expected ? 0 : 1;
      hidden += expected == Occlusion::kHidden ? 1 : 0;
      outside += expected == Occlusion::kOutside ? 1 : 0;
      if (!is_inside) continue;
      const Eigen::Vector2d shift = Eigen::Vector2f(found.shift_px.at<cv::Vec2f>(v, u).val).cast<double>();
      wrong_shifts += (shift - (place - Eigen::Vector2d(u, v))).norm() <= 1e-4 ? 0 : 1;
    }
  }
  EXPECT_EQ(wrong_shifts, 0);
  EXPECT_LE(wrong_fates, 3);  // of 120,000
  EXPECT_GT(hidden, 100);
  EXPECT_GT(outside, 500);
}

INSTANTIATE_TEST_SUITE_P(Rooms, BehindALens, testing::Range(std::uint64_t{0}, std::uint64_t{4}));

// Law: a lens that does not distort shows what a pinhole shows, but for the edges that the rasteriser has
// snapped.
TEST(DistortedIds, OfALensThatDoesNotBendIsThePinholes) {
  const worlds::World world = test::random_room(5);
  const slam::Pose pose = test::random_pose(5);
  const vision::StereoRig rig = test::small_rig();
  const IdBuffer undistorted = Renderer(world, rig).id_buffers(pose, pose).left;
  const IdBuffer distorted = distorted_ids(
      SceneGeometry(world), Renderer(world, pinhole_rig_of(rig)).id_buffers(pose, pose).left, rig);
  EXPECT_LE(cv::countNonZero(distorted.primitive != undistorted.primitive), 5);
}

/// Two walls before the sky, with a hair's breadth between them that a column of the rig's rays goes through,
/// a little beside the middle of the pinhole's pixels.
worlds::World cracked_wall(const vision::StereoRig& rig, int column) {
  constexpr double kAhead_m = 3.0, kCrack_m = 1e-6;
  const double aside_m =
      0.5 * rig.baseline_m - kAhead_m * (column - rig.intrinsics.cx_px) / rig.intrinsics.focal_px;
  worlds::World world;
  world.walls = {{{kAhead_m, 9.0}, {kAhead_m, aside_m + kCrack_m}, 9.0},
                 {{kAhead_m, aside_m - kCrack_m}, {kAhead_m, -9.0}, 9.0}};
  return world;
}

// The rasteriser closes cracks, as it snaps corners to 1/256 px; rays that pass through one see what is
// beside it. Mutation: what no ray meets is open.
TEST(DistortedIds, SeesNoSkyThroughACrackThatTheRasteriserCloses) {
  vision::StereoRig rig = test::small_rig();
  rig.pitch_down_rad = 0.0;
  const int column = 200;
  const worlds::World world = cracked_wall(rig, column);
  const IdBuffer undistorted = Renderer(world, pinhole_rig_of(rig)).id_buffers({}, {}).left;
  ASSERT_EQ(cv::countNonZero(undistorted.primitive == kNoPrimitive), 0) << "it is not closed";
  const SceneGeometry scene(world);
  const IdBuffer distorted = distorted_ids(scene, undistorted, rig);
  const PixelRays lines(distorted.view);
  for (int row = 0; row < 160; ++row) {
    const Ray through = lines(column, row);
    ASSERT_TRUE(std::isinf(scene.enter(kFirstWallPrimitive, through))) << "not into the crack";
    ASSERT_TRUE(std::isinf(scene.enter(kFirstWallPrimitive + 1, through))) << "not into the crack";
    const int seen = distorted.primitive.at<int>(row, column);
    EXPECT_TRUE(seen == kFirstWallPrimitive || seen == kFirstWallPrimitive + 1) << row << ": " << seen;
  }
}

// A lens with k1 alone folds directions beyond 49 degrees back towards the middle of its picture. Mutation:
// places of directions that the picture does not see.
TEST(DistortedIds, HasNoPlaceForWhatTheLensWouldFold) {
  const worlds::World world = test::random_room(7);
  const SceneGeometry scene(world);
  vision::StereoRig rig = test::small_rig();
  rig.distortion.k1 = -0.25;
  Renderer renderer(world, pinhole_rig_of(rig));
  const auto look = [&](double heading_rad) {
    const slam::Pose pose{0.0, 0.0, heading_rad};
    return distorted_ids(scene, renderer.id_buffers(pose, pose).left, rig);
  };
  const IdBuffer ahead = look(0.0), aside = look(1.1);
  const PixelTruth truth = pixel_truth(scene, ahead);
  const Correspondence found = correspond(scene, ahead, aside);
  const PixelRays lines(ahead.view);
  int folded = 0, seen = 0;
  for (int v = 0; v < found.occlusion.rows; ++v) {
    for (int u = 0; u < found.occlusion.cols; ++u) {
      const Ray line = lines(u, v);
      const Eigen::Vector3d point =
          aside.view.camera_from_world *
          (line.origin_m + double{truth.range_m.at<float>(v, u)} * line.direction.normalized());
      if (!(point.z() > 0.01 && point.head<2>().norm() > 1.2 * point.z())) continue;
      folded += vision::is_inside(rig.intrinsics, vision::image_point(rig, point)) ? 1 : 0;
      seen += static_cast<Occlusion>(found.occlusion.at<std::uint8_t>(v, u)) == Occlusion::kOutside ? 0 : 1;
    }
  }
  EXPECT_GT(folded, 1000) << "nothing to be taken in by";
  EXPECT_EQ(seen, 0);
}

// Rows that are looked at alone are those of the whole picture, and so is what follows from them.
// Mutation: views of the whole picture for some of its rows.
TEST(IdBuffer, OfSomeRowsIsTheWholeOnes) {
  const worlds::World world = test::random_room(6);
  const slam::Pose pose = test::random_pose(6);
  Renderer renderer(world, test::small_rig());
  const SceneGeometry scene(world);
  const PixelTruth whole = pixel_truth(scene, renderer.id_buffers(pose, pose).right);
  const cv::Range rows(101, 160);
  const PixelTruth part = pixel_truth(scene, renderer.id_buffers(pose, pose, rows).right);
  EXPECT_EQ(cv::countNonZero(part.surface != whole.surface.rowRange(rows)), 0);
  EXPECT_LE(cv::norm(part.range_m, whole.range_m.rowRange(rows), cv::NORM_INF), 1e-5);
  EXPECT_LE(cv::norm(part.normal, whole.normal.rowRange(rows), cv::NORM_INF), 1e-6);
}

}  // namespace
}  // namespace stereobench::renderer
