/// Identities and depth of every pixel against the double-precision ray-caster.
///
/// Mutations seen red here: half a pixel added to u, to v, or to the balls' centres only; the cameras
/// swapped; the rows flipped; the near root of the sphere exchanged for the far one; rims that write identity
/// or depth; no depth test; a mesh without its scale; 16 bits of depth.

#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "renderer/renderer.h"
#include "tests/renderer/folder.h"
#include "tests/renderer/random_scene.h"
#include "tests/renderer/ray_caster.h"

namespace stereobench::renderer {
namespace {

/// The rasteriser snaps corners of walls to 1/256 px: nearer than this to an edge it may see the other side.
constexpr double kSnap_px = 0.006;
/// Single precision, relative: a few roundings of 2^-24 in the rasteriser's plane equation.
constexpr double kDepthTolerance = 4e-6;

struct Tally {
  long pixels = 0;
  long wrong_ids = 0;
  long wrong_ids_inside = 0;  ///< farther than a thousandth of a pixel from any outline
  long wrong_depths = 0;
  double squared_m2 = 0.0;  ///< of depth errors from 1 to 6 m
  long near_pixels = 0;
};

/// Whether the depth differs from the truth by no more than depths differ a hair beside the pixel's centre.
bool seen_beside(const test::RayCaster& caster, const cv::Point& at, double depth_m, double truth_m) {
  double least_m = truth_m;
  double most_m = truth_m;
  for (const double du : {-kSnap_px, kSnap_px}) {
    for (const double dv : {-kSnap_px, kSnap_px}) {
      const double beside_m = caster.look(at.x + du, at.y + dv).depth_m;
      least_m = std::min(least_m, beside_m);
      most_m = std::max(most_m, beside_m);
    }
  }
  return std::abs(depth_m - truth_m) <= 1.001 * (most_m - least_m);  // four looks do not meet the extremes
}

void compare_pixel(const RenderedImage& frame, const test::RayCaster& caster, const cv::Point& at,
                   Tally& tally) {
  const test::RayHit truth = caster.look(at.x, at.y);
  const double depth_m = double{frame.depth_m.at<float>(at)};
  ++tally.pixels;
  if (frame.ball_id.at<std::uint8_t>(at) != truth.ball_id) {
    ++tally.wrong_ids;
    if (truth.edge_px > 1e-3) ++tally.wrong_ids_inside;
    return;
  }
  const double error_m = depth_m == truth.depth_m ? 0.0 : std::abs(depth_m - truth.depth_m);
  if (!(error_m <= kDepthTolerance * truth.depth_m)) {
    // At a grazing rim depth changes without bound: there the two may differ by what a hair aside changes.
    if (!seen_beside(caster, at, depth_m, truth.depth_m)) ++tally.wrong_depths;
    return;
  }
  if (truth.depth_m < 1.0 || truth.depth_m > 6.0) return;
  tally.squared_m2 += error_m * error_m;
  ++tally.near_pixels;
}

void compare_image(const RenderedImage& frame, const test::RayCaster& caster, Tally& tally) {
  for (int v = 0; v < frame.depth_m.rows; ++v) {
    for (int u = 0; u < frame.depth_m.cols; ++u) compare_pixel(frame, caster, {u, v}, tally);
  }
}

Tally compare(const StereoFrame& frame, test::RayCaster caster, const slam::Pose& pose) {
  Tally tally;
  caster.stand_at(pose, vision::Side::kLeft);
  compare_image(frame.left, caster, tally);
  caster.stand_at(pose, vision::Side::kRight);
  compare_image(frame.right, caster, tally);
  return tally;
}

void expect_true(const Tally& tally) {
  testing::Test::RecordProperty("wrong_ids", std::to_string(tally.wrong_ids));
  testing::Test::RecordProperty(
      "depth_rms_m",
      std::to_string(1e6 * std::sqrt(tally.squared_m2 / static_cast<double>(tally.near_pixels))) + "e-6");
  EXPECT_EQ(tally.wrong_ids_inside, 0);
  EXPECT_LE(static_cast<double>(tally.wrong_ids), 5e-6 * static_cast<double>(tally.pixels) + 1.0);
  EXPECT_EQ(tally.wrong_depths, 0);
  ASSERT_GT(tally.near_pixels, tally.pixels / 4);
  EXPECT_LE(std::sqrt(tally.squared_m2 / static_cast<double>(tally.near_pixels)), 1e-5);
}

class Truth : public testing::TestWithParam<std::uint64_t> {};

TEST_P(Truth, EveryPixelOfARoomIsWhatARayMeetsFirst) {
  const worlds::World world = test::random_room(GetParam());
  const vision::StereoRig rig = test::small_rig();
  const slam::Pose pose = test::random_pose(GetParam());
  const StereoFrame frame = Renderer(world, rig).render(pose);
  expect_true(compare(frame, test::RayCaster(world, rig), pose));
}

INSTANTIATE_TEST_SUITE_P(Seeds, Truth, testing::Range(std::uint64_t{0}, std::uint64_t{8}));

// Law: without a floor a pixel sees what a ray meets of the rest, and nothing in the floor's place: no
// identity, infinitely far, the sky's colour. Mutations: the floor drawn all the same; it is black.
TEST_P(Truth, WithoutAFloorNothingIsSeenInItsPlace) {
  worlds::World world = test::random_room(GetParam());
  world.has_floor = false;
  world.walls.pop_back();
  world.walls.resize(2);
  world.sky_rgb = {0.2, 0.4, 0.6};
  const slam::Pose pose = test::random_pose(GetParam());
  const StereoFrame frame = Renderer(world, test::small_rig()).render(pose);
  const Tally tally = compare(frame, test::RayCaster(world, test::small_rig()), pose);
  EXPECT_EQ(tally.wrong_ids_inside, 0);
  EXPECT_EQ(tally.wrong_depths, 0);
  const cv::Mat nothing = frame.left.depth_m == std::numeric_limits<float>::infinity();
  EXPECT_GT(cv::countNonZero(nothing.rowRange(250, 300)), 5000) << "where the floor was";
  cv::Mat inner;
  cv::erode(nothing, inner, cv::Mat::ones(3, 3, CV_8U));
  cv::Mat other;
  cv::inRange(frame.left.colour, cv::Scalar(153, 102, 51), cv::Scalar(153, 102, 51), other);
  EXPECT_LE(cv::countNonZero(~other & inner), 1) << "of 120,000: a sliver of a ball that no centre sees";
  EXPECT_EQ(cv::countNonZero(frame.left.ball_id & nothing), 0);
}

TEST(Truth, BallsFarFromTheWorldsOriginKeepTheirDepth) {
  worlds::World world = test::random_room(3);
  const Eigen::Vector2d far(400.0, -250.0);
  for (worlds::Ball& ball : world.balls) ball.centre_m.head<2>() += far;
  for (worlds::Wall& wall : world.walls) wall.from_m += far, wall.to_m += far;
  const slam::Pose pose{far.x(), far.y(), 0.4};
  const StereoFrame frame = Renderer(world, test::small_rig()).render(pose);
  expect_true(compare(frame, test::RayCaster(world, test::small_rig()), pose));
}

TEST(Truth, AMeshStandsTurnsAndScalesAsTheScenarioSays) {
  const test::Folder folder;
  const std::string file =
      folder.write("wedge.obj", "v 0 0 0\nv 1 0 0\nv 0 0.5 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  worlds::World world = test::random_room(5);
  world.meshes.push_back({file, {1.6, 0.2, 0.1}, 0.8, {0.5, 1.5, 0.6}, worlds::Material::kWood});
  std::vector<Triangle> triangles = read_mesh(file);
  for (Triangle& triangle : triangles) {
    for (Eigen::Vector3d& corner : triangle.corners) {
      corner = Eigen::Vector3d(1.6, 0.2, 0.1) + Eigen::AngleAxisd(0.8, Eigen::Vector3d::UnitZ()) *
                                                    Eigen::Vector3d(0.5, 1.5, 0.6).cwiseProduct(corner);
    }
  }
  const StereoFrame frame = Renderer(world, test::small_rig()).render({});
  const test::RayCaster with(world, test::small_rig(), triangles);
  expect_true(compare(frame, with, {}));
  EXPECT_GT(compare(frame, test::RayCaster(world, test::small_rig()), {}).wrong_depths, 1000)
      << "not in view";
}

TEST(Truth, NothingIsInfinitelyFar) {
  const StereoFrame frame = Renderer(test::flat_sky({}), test::rig_looking_up()).render({});
  for (const RenderedImage* image : {&frame.left, &frame.right}) {
    EXPECT_EQ(cv::countNonZero(image->depth_m == std::numeric_limits<float>::infinity()), 400 * 300);
    EXPECT_EQ(cv::countNonZero(image->ball_id), 0);
  }
}

}  // namespace
}  // namespace stereobench::renderer
