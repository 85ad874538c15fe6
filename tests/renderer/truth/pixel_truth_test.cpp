/// Primitives, ranges, normals, disparity and flow of every pixel against the double-precision ray-caster.
///
/// Mutations seen red here: occluders of one pixel around the place instead of four; a ball that does not
/// hide its own far side; walls without bounds, triangles as parallelograms; a right camera that is not
/// turned, disparity of the other sign; normals away from the camera or in the world frame, depth for range;
/// the ball's far root; half a pixel added to rays; triangles numbered one late, walls in the order they are
/// drawn in; hidden called outside; no near plane; balls' primitives without their depth.

#include "renderer/truth/pixel_truth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <gtest/gtest.h>

#include "renderer/renderer.h"
#include "renderer/truth/correspondence.h"
#include "tests/renderer/random_scene.h"
#include "tests/renderer/ray_caster.h"
#include "tests/renderer/wedge.h"

namespace stereobench::renderer {
namespace {

using vision::Side;

/// A room with a mesh, and some without a floor, seen by a rig whose right camera is out of place, before and
/// after a move.
struct Room {
  explicit Room(std::uint64_t seed) : world(test::random_room(seed)), pose(test::random_pose(seed)) {
    if (seed % 2 == 0) pose = {0.0, 0.0, 0.2};  // the mesh is in view
    triangles = test::add_wedge(world);
    world.has_floor = seed % 4 != 1;
    rig.right_turn_rad = {0.004, -0.007, 0.011};
    moved = {pose.x_m + 0.05, pose.y_m - 0.03, pose.heading_rad + 0.06};
  }
  test::RayCaster caster(const slam::Pose& at, Side side) const {
    test::RayCaster result(world, rig, triangles);
    result.stand_at(at, side);
    return result;
  }

  worlds::World world;
  vision::StereoRig rig = test::small_rig();
  std::vector<Triangle> triangles;
  slam::Pose pose, moved;
};

/// Disagreements, in pixels, and what was looked at.
struct PixelTally {
  long pixels = 0;
  long other_surfaces = 0,
       other_inside = 0;  ///< inside: farther from any edge than the rasteriser snaps corners
  long wrong_ranges = 0, wrong_normals = 0;
  long wrong_shifts = 0, wrong_fates = 0;
  std::map<Occlusion, long> occlusions;
};

/// Whether a ray a hair beside the pixel's centre meets the primitive: the rasteriser snaps corners to 1/256
/// px.
bool is_beside(int primitive, const test::RayCaster& caster, int u, int v) {
  constexpr double kSnap_px = 0.006;
  for (const double du : {-kSnap_px, 0.0, kSnap_px}) {
    for (const double dv : {-kSnap_px, 0.0, kSnap_px}) {
      if (caster.primitive(caster.look(u + du, v + dv).surface) == primitive) return true;
    }
  }
  return false;
}

/// Counts a pixel. @return whether the ray meets the primitive that the renderer has there
bool is_same_primitive(const Room& room, int primitive, const test::RayCaster& caster, const cv::Point& at,
                       PixelTally& tally) {
  const int truth = caster.primitive(caster.look(at.x, at.y).surface);
  const int first_mesh = first_mesh_primitive(room.world);  // there is one mesh
  ++tally.pixels;
  if (std::min(primitive, first_mesh) != std::min(truth, first_mesh)) {
    ++tally.other_surfaces;
    tally.other_inside += primitive < first_mesh && !is_beside(primitive, caster, at.x, at.y) ? 1 : 0;
  }
  return primitive == truth;
}

void compare_truth(const Room& room, const IdBuffer& ids, const test::RayCaster& caster, PixelTally& tally) {
  const PixelTruth truth = pixel_truth(SceneGeometry(room.world), ids);
  for (int v = 0; v < truth.range_m.rows; ++v) {
    for (int u = 0; u < truth.range_m.cols; ++u) {
      const int primitive = ids.primitive.at<int>(v, u);
      if (!is_same_primitive(room, primitive, caster, {u, v}, tally)) continue;
      const test::RayHit ray = caster.look(u, v);
      const double truth_m = ray.surface == 0 ? ray.depth_m : caster.in_camera(ray.point_m).norm();
      const double range_m = double{truth.range_m.at<float>(v, u)};
      const Eigen::Vector3d normal = Eigen::Vector3f(truth.normal.at<cv::Vec3f>(v, u).val).cast<double>();
      EXPECT_EQ(truth.surface.at<int>(v, u), std::min(primitive, first_mesh_primitive(room.world)));
      tally.wrong_ranges += range_m == truth_m || std::abs(range_m - truth_m) <= 1e-6 * truth_m ? 0 : 1;
      tally.wrong_normals += (normal - ray.normal).norm() <= 1e-4 ? 0 : 1;
    }
  }
}

/// A point's place in a camera's picture, and what becomes of it there by casting another ray.
Occlusion followed(const test::RayHit& ray, const test::RayCaster& to, const vision::Intrinsics& camera,
                   Eigen::Vector2d& place_px) {
  if (ray.surface == 0) return Occlusion::kNothing;
  const Eigen::Vector3d point = to.in_camera(ray.point_m);
  place_px.x() = camera.cx_px + camera.focal_px * point.x() / point.z();
  place_px.y() = camera.cy_px + camera.focal_px * point.y() / point.z();
  const bool inside = point.z() > 0.01 && place_px.minCoeff() >= -0.5 &&
                      place_px.x() <= camera.width_px - 0.5 && place_px.y() <= camera.height_px - 0.5;
  if (!inside) return Occlusion::kOutside;
  return to.look(place_px.x(), place_px.y()).depth_m < point.z() * (1.0 - 1e-7) ? Occlusion::kHidden
                                                                                : Occlusion::kSeen;
}

void compare_fates(const Room& room, const IdBuffer& ids, const IdBuffer& other, const test::RayCaster& from,
                   const test::RayCaster& to, PixelTally& tally) {
  const Correspondence found = correspond(SceneGeometry(room.world), ids, other);
  for (int v = 0; v < found.occlusion.rows; ++v) {
    for (int u = 0; u < found.occlusion.cols; ++u) {
      if (!is_same_primitive(room, ids.primitive.at<int>(v, u), from, {u, v}, tally)) continue;
      Eigen::Vector2d place_px = Eigen::Vector2d::Zero();
      const Occlusion occlusion = followed(from.look(u, v), to, other.view.intrinsics, place_px);
      const Eigen::Vector2d shift = Eigen::Vector2f(found.shift_px.at<cv::Vec2f>(v, u).val).cast<double>();
      const Eigen::Vector2d off = shift - (place_px - Eigen::Vector2d(u, v));
      if (occlusion == Occlusion::kSeen || occlusion == Occlusion::kHidden)
        tally.wrong_shifts += off.norm() <= 1e-4 ? 0 : 1;
      tally.wrong_fates +=
          static_cast<Occlusion>(found.occlusion.at<std::uint8_t>(v, u)) == occlusion ? 0 : 1;
      ++tally.occlusions[occlusion];
    }
  }
}

class EveryPixel : public testing::TestWithParam<std::uint64_t> {};

TEST_P(EveryPixel, HasTheRangeNormalAndSurfaceThatARayMeets) {
  const Room room(GetParam());
  const StereoIdBuffers ids = Renderer(room.world, room.rig).id_buffers(room.pose, room.pose);
  PixelTally tally;
  compare_truth(room, ids.left, room.caster(room.pose, Side::kLeft), tally);
  compare_truth(room, ids.right, room.caster(room.pose, Side::kRight), tally);
  EXPECT_EQ(tally.wrong_ranges, 0);
  EXPECT_EQ(tally.wrong_normals, 0);
  EXPECT_EQ(tally.other_inside, 0);
}

TEST_P(EveryPixel, IsInTheOtherCameraWhereAnotherRaySaysItIs) {
  const Room room(GetParam());
  const StereoIdBuffers ids = Renderer(room.world, room.rig).id_buffers(room.pose, room.pose);
  const auto left = room.caster(room.pose, Side::kLeft), right = room.caster(room.pose, Side::kRight);
  PixelTally tally;
  compare_fates(room, ids.left, ids.right, left, right, tally);
  compare_fates(room, ids.right, ids.left, right, left, tally);
  EXPECT_EQ(tally.wrong_shifts, 0);
  EXPECT_LE(tally.wrong_fates, 2);  // of 240,000
  EXPECT_GT(tally.occlusions[Occlusion::kHidden], 1000);
  EXPECT_GT(tally.occlusions[Occlusion::kOutside], 1000);
}

TEST_P(EveryPixel, FlowsToWhereARayFromTheNextPoseMeetsIt) {
  const Room room(GetParam());
  Renderer renderer(room.world, room.rig);
  const StereoIdBuffers before = renderer.id_buffers(room.pose, room.pose);
  const StereoIdBuffers after = renderer.id_buffers(room.moved, room.moved);
  PixelTally tally;
  compare_fates(room, before.left, after.left, room.caster(room.pose, Side::kLeft),
                room.caster(room.moved, Side::kLeft), tally);
  compare_fates(room, before.right, after.right, room.caster(room.pose, Side::kRight),
                room.caster(room.moved, Side::kRight), tally);
  EXPECT_EQ(tally.wrong_shifts, 0);
  EXPECT_LE(tally.wrong_fates, 2);
  EXPECT_GT(tally.occlusions[Occlusion::kHidden], 100);
  EXPECT_GT(tally.occlusions[Occlusion::kOutside], 10000);
}

// Mutation: without other_x_ or other_y_ of RowShift this turns red.
TEST_P(EveryPixel, IsInAPictureOfAnotherFocalLengthWhereARaySaysItIs) {
  const Room room(GetParam());
  Room zoomed(GetParam());
  zoomed.rig.intrinsics.focal_px *= 1.2;
  zoomed.rig.intrinsics.cx_px += 5.0;
  zoomed.rig.intrinsics.cy_px -= 3.0;
  const IdBuffer left = Renderer(room.world, room.rig).id_buffers(room.pose, room.pose).left;
  const IdBuffer other = Renderer(room.world, zoomed.rig).id_buffers(room.moved, room.moved).left;
  PixelTally tally;
  compare_fates(room, left, other, room.caster(room.pose, Side::kLeft),
                zoomed.caster(room.moved, Side::kLeft), tally);
  EXPECT_EQ(tally.wrong_shifts, 0);
  EXPECT_LE(tally.wrong_fates, 2);
}

INSTANTIATE_TEST_SUITE_P(Rooms, EveryPixel, testing::Range(std::uint64_t{0}, std::uint64_t{6}));

// Of the pixels of whole pictures, at most five of a million see another surface than a ray does, all of them
// at edges that the rasteriser has snapped.
TEST(Surfaces, AreThoseThatRaysMeet) {
  PixelTally tally;
  for (std::uint64_t seed = 0; seed < 2; ++seed) {
    Room room(seed);
    room.rig.intrinsics = {};
    const StereoIdBuffers ids = Renderer(room.world, room.rig).id_buffers(room.pose, room.pose);
    for (const auto& [side, seen] :
         {std::pair(Side::kLeft, &ids.left), std::pair(Side::kRight, &ids.right)}) {
      const test::RayCaster caster = room.caster(room.pose, side);
      for (int v = 0; v < seen->primitive.rows; ++v) {
        for (int u = 0; u < seen->primitive.cols; ++u) {
          is_same_primitive(room, seen->primitive.at<int>(v, u), caster, {u, v}, tally);
        }
      }
    }
  }
  RecordProperty("other_surfaces", std::to_string(tally.other_surfaces));
  EXPECT_EQ(tally.other_inside, 0);
  EXPECT_LE(static_cast<double>(tally.other_surfaces), 5e-6 * static_cast<double>(tally.pixels));
}

/// Every pixel of both cameras.
template <typename Check>
void for_each_pixel(const cv::Mat& picture, Check check) {
  for (int v = 0; v < picture.rows; ++v) {
    for (int u = 0; u < picture.cols; ++u) check(u, v);
  }
}

// Law: disparity times depth is focal length times baseline, where the rig is rectified.
TEST(Disparity, TimesDepthIsFocalLengthTimesBaseline) {
  Room room(2);
  room.rig.right_turn_rad.setZero();
  Renderer renderer(room.world, room.rig);
  const StereoIdBuffers ids = renderer.id_buffers(room.pose, room.pose);
  const StereoFrame frame = renderer.render(room.pose);
  const SceneGeometry scene(room.world);
  const cv::Mat left = disparity_px(correspond(scene, ids.left, ids.right), Side::kLeft);
  const cv::Mat right = disparity_px(correspond(scene, ids.right, ids.left), Side::kRight);
  const double fb = room.rig.intrinsics.focal_px * room.rig.baseline_m;
  int wrong = 0;
  for_each_pixel(left, [&](int u, int v) {
    for (const auto& [disparity, image] : {std::pair(&left, &frame.left), std::pair(&right, &frame.right)}) {
      const double depth_m = double{image->depth_m.at<float>(v, u)};
      const double found_px = double{disparity->at<float>(v, u)};
      wrong +=
          std::isinf(depth_m) ? !std::isinf(found_px) : !(std::abs(found_px * depth_m / fb - 1.0) < 1e-5);
    }
  });
  EXPECT_LE(wrong, 5);  // pixels at a ball's rim, where depth changes without bound, and at snapped edges
}

// Law: who does not move sees nothing move.
TEST(Flow, OfNoMotionIsZero) {
  const Room room(4);
  const StereoIdBuffers ids = Renderer(room.world, room.rig).id_buffers(room.pose, room.pose);
  const Correspondence still = correspond(SceneGeometry(room.world), ids.right, ids.right);
  int wrong = 0;
  for_each_pixel(still.occlusion, [&](int u, int v) {
    const bool nothing = ids.right.primitive.at<int>(v, u) == kNoPrimitive;
    const cv::Vec2f shift = still.shift_px.at<cv::Vec2f>(v, u);
    const Occlusion occlusion = static_cast<Occlusion>(still.occlusion.at<std::uint8_t>(v, u));
    wrong += nothing ? occlusion != Occlusion::kNothing
                     : occlusion != Occlusion::kSeen || shift[0] != 0.0F || shift[1] != 0.0F;
  });
  EXPECT_EQ(wrong, 0);
}

TEST(Flow, OfWhatIsBehindTheNextPoseHasNoPlace) {
  const Room room(1);
  Renderer renderer(room.world, room.rig);
  const slam::Pose turned{room.pose.x_m, room.pose.y_m, room.pose.heading_rad + M_PI};
  const IdBuffer before = renderer.id_buffers(room.pose, room.pose).left;
  const Correspondence found =
      correspond(SceneGeometry(room.world), before, renderer.id_buffers(turned, turned).left);
  EXPECT_EQ(cv::countNonZero(found.occlusion == static_cast<int>(Occlusion::kOutside)),
            cv::countNonZero(before.primitive));
  EXPECT_EQ(cv::countNonZero(disparity_px(found, Side::kRight) == std::numeric_limits<float>::infinity()),
            400 * 300);
}

/// Whether a colour is within a few levels of those of the four pixels around a place.
bool is_colour_around(const cv::Vec3b& colour, const cv::Mat& picture, double x, double y) {
  constexpr int kShading_levels = 3;  // of a ball within a pixel, and rounding
  const int u = std::clamp(static_cast<int>(std::floor(x)), 0, picture.cols - 2);
  const int v = std::clamp(static_cast<int>(std::floor(y)), 0, picture.rows - 2);
  for (int channel = 0; channel < 3; ++channel) {
    const auto [least, most] =
        std::minmax({picture.at<cv::Vec3b>(v, u)[channel], picture.at<cv::Vec3b>(v, u + 1)[channel],
                     picture.at<cv::Vec3b>(v + 1, u)[channel], picture.at<cv::Vec3b>(v + 1, u + 1)[channel]});
    if (colour[channel] < least - kShading_levels || colour[channel] > most + kShading_levels) return false;
  }
  return true;
}

// Law: what both cameras see has one colour, light being the same from everywhere.
TEST(Disparity, TakesColoursOfTheRightPictureToTheLeftOne) {
  Room room(0);
  for (worlds::Wall& wall : room.world.walls) wall.material = worlds::Material::kPlain;
  room.world.floor = worlds::Material::kPlain;
  Renderer renderer(room.world, room.rig);
  const StereoIdBuffers ids = renderer.id_buffers(room.pose, room.pose);
  const StereoFrame frame = renderer.render(room.pose);
  const Correspondence found = correspond(SceneGeometry(room.world), ids.left, ids.right);
  long compared = 0, other_colours = 0;
  for_each_pixel(found.occlusion, [&](int u, int v) {
    if (static_cast<Occlusion>(found.occlusion.at<std::uint8_t>(v, u)) != Occlusion::kSeen) return;
    const cv::Vec2f shift = found.shift_px.at<cv::Vec2f>(v, u);
    ++compared;
    const cv::Vec3b colour = frame.left.colour.at<cv::Vec3b>(v, u);
    const double x = u + double{shift[0]}, y = v + double{shift[1]};
    other_colours += is_colour_around(colour, frame.right.colour, x, y) ? 0 : 1;
  });
  EXPECT_GT(compared, 90000);
  EXPECT_LE(other_colours, compared / 500);  // edges, where pixels are mixtures
}

}  // namespace
}  // namespace stereobench::renderer
