/// Lenses: OpenCV's equations, undone.

#include "vision/camera/distortion.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>

#include "slam/math/random.h"
#include "vision/camera/rig.h"

namespace stereobench::vision {
namespace {

const Intrinsics kCamera = {640, 480, 400.0, 318.0, 242.0};

struct NamedLens {
  const char* name;
  Distortion lens;
};

void PrintTo(const NamedLens& named, std::ostream* out) {
  *out << named.name;
}

class LensModel : public testing::TestWithParam<NamedLens> {};

// Mutations: p1 for p2, 3 k3 without its 3 in the slope, the aspect left out of the slope.
TEST_P(LensModel, IsOpenCvsAndCanBeUndone) {
  const Distortion& lens = GetParam().lens;
  const cv::Matx<double, 1, 5> coefficients(lens.k1, lens.k2, lens.p1, lens.p2, lens.k3);
  const auto seen = directions_seen(lens, kCamera);
  ASSERT_TRUE(seen);
  slam::RandomStream random(1, slam::Stream::kWorld);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector2d direction(0.8 * (2.0 * random.uniform() - 1.0),
                                    0.6 * (2.0 * random.uniform() - 1.0));
    std::vector<cv::Point2d> expected;
    cv::projectPoints(std::vector<cv::Point3d>{{direction.x(), direction.y(), 1.0}}, cv::Vec3d(0, 0, 0),
                      cv::Vec3d(0, 0, 0), cv::Matx33d::eye(), coefficients, expected);
    const Eigen::Vector2d place = distort(lens, direction);
    EXPECT_NEAR(place.x(), expected[0].x, 1e-14);
    EXPECT_NEAR(place.y(), lens.pixel_aspect * expected[0].y, 1e-14);
    constexpr double kStep = 1e-6;
    for (int axis = 0; axis < 2; ++axis) {
      const Eigen::Vector2d step = kStep * Eigen::Vector2d::Unit(axis);
      const Eigen::Vector2d slope =
          (distort(lens, direction + step) - distort(lens, direction - step)) / (2.0 * kStep);
      EXPECT_LT((distortion_slope(lens, direction).col(axis) - slope).norm(), 1e-8);
    }
    if (!is_inside(kCamera, project(kCamera, place.homogeneous()))) continue;
    const auto undone = undistort(lens, place);
    ASSERT_TRUE(undone) << direction.transpose();
    EXPECT_LT((*undone - direction).norm(), 1e-12);
    EXPECT_TRUE(seen->contains(direction));
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, LensModel,
    testing::Values(NamedLens{"pinhole", {}},
                    NamedLens{"barrel", {.k1 = -0.28, .k2 = 0.07, .p1 = 0.001, .p2 = -0.002}},
                    NamedLens{"pincushion", {.k1 = 0.2, .k2 = 0.05, .p1 = -0.001, .k3 = 0.01}},
                    NamedLens{"stretched", {.pixel_aspect = 0.8}},
                    NamedLens{"stretched barrel", {.k1 = -0.28, .k2 = 0.07, .pixel_aspect = 1.25}}));

// r - 2 r^3 turns back at r = 0.41: the corners, at 0.99, show nothing that a ray could bring there.
TEST(LensModel, ThatFoldsItsPictureIsSeenThrough) {
  EXPECT_FALSE(directions_seen({.k1 = -2.0}, kCamera));
  EXPECT_FALSE(undistort({.k1 = -2.0}, {0.9, 0.4}));
  EXPECT_TRUE(undistort({.k1 = -2.0}, {0.1, 0.1}));
  EXPECT_FALSE(directions_seen({.k1 = std::numeric_limits<double>::quiet_NaN()}, kCamera));
  EXPECT_FALSE(directions_seen({}, {640, 480, 50.0, 319.5, 239.5})) << "81 degrees to the side";
}

}  // namespace
}  // namespace stereobench::vision
