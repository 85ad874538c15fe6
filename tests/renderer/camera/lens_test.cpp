/// Lenses that distort: where balls appear, what truth is kept, and what is refused.

#include "renderer/camera/lens.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "renderer/renderer.h"
#include "vision/camera/pinhole_rig.h"
#include "vision/camera/rig.h"
#include "vision/palette.h"

namespace stereobench::renderer {
namespace {

constexpr vision::Distortion kBarrel = {.k1 = -0.28, .k2 = 0.07, .p1 = 0.001, .p2 = -0.002};
constexpr vision::Distortion kPincushion = {.k1 = 0.2, .k2 = 0.05, .p1 = -0.001, .p2 = 0.0, .k3 = 0.01};
constexpr double kBallRadius_m = 0.1;

/// A rig that looks at the sky.
vision::StereoRig rig_with(const vision::Distortion& lens) {
  vision::StereoRig rig;
  rig.intrinsics = {640, 480, 400.0, 318.0, 242.0};
  rig.pitch_down_rad = -1.2;
  rig.distortion = lens;
  return rig;
}

/// One ball without shading before a black sky, at a place of the left camera's frame.
worlds::World ball_at(const vision::StereoRig& rig, const Eigen::Vector3d& ball_in_camera) {
  worlds::World world;
  world.sky_rgb.setZero();
  world.light.ambient = 1.0;
  world.light.diffuse = 0.0;
  world.balls = {{vision::robot_from_camera(rig) * ball_in_camera, kBallRadius_m, 0}};
  return world;
}

/// Area, centroid and whatever else moments tell.
cv::Moments light_of(const cv::Mat& picture) {
  cv::Mat red;
  cv::extractChannel(picture, red, 2);
  return cv::moments(red);
}

/// The same of the outline: rays that touch the ball, each distorted by the lens on its own.
cv::Moments distorted_outline(const vision::StereoRig& rig, const Eigen::Vector3d& ball) {
  constexpr int kPoints = 2000;
  const double sine = kBallRadius_m / ball.norm();
  const Eigen::Vector3d axis = ball.normalized();
  const Eigen::Vector3d side = axis.unitOrthogonal();
  std::vector<cv::Point2f> outline;
  for (int i = 0; i < kPoints; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / kPoints;
    const Eigen::Vector3d across = std::cos(turn) * side + std::sin(turn) * axis.cross(side);
    const Eigen::Vector2d at = vision::image_point(rig, std::sqrt(1.0 - sine * sine) * axis + sine * across);
    outline.emplace_back(static_cast<float>(at.x()), static_cast<float>(at.y()));
  }
  return cv::moments(outline);
}

struct NamedLens {
  const char* name;
  vision::Distortion lens;
};

void PrintTo(const NamedLens& named, std::ostream* out) {
  *out << named.name;
}

class LensTest : public testing::TestWithParam<NamedLens> {};

// Mutation: half a pixel in places_of_row.
TEST_P(LensTest, ShowsBallsWhereDistortedRaysArrive) {
  const vision::StereoRig rig = rig_with(GetParam().lens);
  const double full = vision::kPalette[0].r;
  for (const double x : {-1.2, -0.4, 0.5, 1.2}) {
    for (const double y : {-0.9, 0.1, 0.8}) {
      const Eigen::Vector3d ball(x, y, 2.0);
      const cv::Moments seen = light_of(Renderer(ball_at(rig, ball), rig).render({}).left.colour);
      const cv::Moments expected = distorted_outline(rig, ball);
      EXPECT_NEAR(seen.m10 / seen.m00, expected.m10 / expected.m00, 0.01) << x << ' ' << y;
      EXPECT_NEAR(seen.m01 / seen.m00, expected.m01 / expected.m00, 0.01) << x << ' ' << y;
      EXPECT_NEAR(seen.m00 / full / expected.m00, 1.0, 0.005) << x << ' ' << y;
    }
  }
}

/// By how much the light of small balls is spread further than their outlines, each way, in squared pixels:
/// the mean over balls near the picture's middle, and over those towards its corners.
struct Blurs {
  Eigen::Vector2d inner, outer;
};

Blurs blurs_behind(const vision::Distortion& lens) {
  const vision::StereoRig rig = rig_with(lens);
  worlds::World world = ball_at(rig, {0.0, 0.0, 15.0});
  const Eigen::Matrix3d turn = vision::robot_from_camera(rig).linear();
  const Eigen::Vector3d middle_m = world.balls.front().centre_m;
  std::vector<Eigen::Vector3d> places;
  for (double x = -9.0; x <= 9.0; x += 1.23)
    for (double y = -6.0; y <= 6.0; y += 1.11) {
      const double i = static_cast<double>(places.size());  // at all places between pixels
      places.emplace_back(x + 0.2 * std::fmod(0.618 * i, 1.0), y + 0.2 * std::fmod(0.755 * i, 1.0), 15.0);
    }
  world.balls.clear();
  for (const Eigen::Vector3d& at : places)
    world.balls.push_back({middle_m + turn * (at - Eigen::Vector3d(0.0, 0.0, 15.0)), kBallRadius_m, 0});
  const cv::Mat picture =
      Renderer(world, rig, Backend::kSoftware, LightDepth::kSixteenBits).render({}).left.colour;
  Eigen::Vector2d sum[2] = {Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  int balls[2] = {0, 0};
  for (const Eigen::Vector3d& at : places) {
    constexpr int kAround_px = 9;
    const Eigen::Vector2d centre = vision::image_point(rig, at);
    const cv::Rect area(static_cast<int>(centre.x()) - kAround_px, static_cast<int>(centre.y()) - kAround_px,
                        2 * kAround_px, 2 * kAround_px);
    const cv::Moments seen = light_of(picture(area)), outline = distorted_outline(rig, at);
    const std::size_t part = at.head<2>().norm() < 5.0 ? 0 : 1;
    sum[part] += Eigen::Vector2d(seen.mu20 / seen.m00 - outline.mu20 / outline.m00,
                                 seen.mu02 / seen.m00 - outline.mu02 / outline.m00);
    ++balls[part];
  }
  return {sum[0] / balls[0], sum[1] / balls[1]};
}

class LensBlur : public testing::TestWithParam<NamedLens> {};

// A box of a pixel without a lens; behind one, what a pinhole of finite density cannot do without. Mutations:
// the least spread at all places; a pixel's own variance forgotten; the least density for all lenses.
TEST_P(LensBlur, IsTheSameAllOverThePicture) {
  constexpr double kOfAPixel = 1.0 / 12.0, kDensity = vision::kLeastPinholeDensity;
  const bool is_straight = GetParam().lens == vision::Distortion{};
  const double expected = is_straight ? kOfAPixel : (kLeastSpread + kOfAPixel) / (kDensity * kDensity);
  const double three_sds = is_straight ? 0.006 : 0.014;  // 0.037 for a ball, of some 65 balls each
  const Blurs blurs = blurs_behind(GetParam().lens);
  for (int axis = 0; axis < 2; ++axis) {
    EXPECT_NEAR(blurs.inner[axis], expected, three_sds) << axis;
    EXPECT_NEAR(blurs.outer[axis], expected, three_sds) << axis;
  }
}

INSTANTIATE_TEST_SUITE_P(All, LensBlur,
                         testing::Values(NamedLens{"pinhole", {}}, NamedLens{"barrel", kBarrel},
                                         NamedLens{"pincushion", {.k1 = 0.12, .p1 = -0.001}},
                                         NamedLens{"low_pixels", {.pixel_aspect = 0.85}},
                                         NamedLens{"high_pixels", {.pixel_aspect = 1.2}}));

// Mutation: truth of the pixel to the left.
TEST_P(LensTest, KeepsTruthAndLightTogether) {
  const vision::StereoRig rig = rig_with(GetParam().lens);
  const RenderedImage frame = Renderer(ball_at(rig, {0.9, -0.6, 2.0}), rig).render({}).left;
  cv::Mat red;
  cv::extractChannel(frame.colour, red, 2);
  int balls = 0;
  for (int row = 0; row < red.rows; ++row) {
    for (int column = 0; column < red.cols; ++column) {
      const int level = red.at<std::uint8_t>(row, column);
      const bool ball = frame.ball_id.at<std::uint8_t>(row, column) == 1;
      EXPECT_EQ(std::isfinite(frame.depth_m.at<float>(row, column)), ball);
      EXPECT_TRUE(ball ? level > 0 : level < vision::kPalette[0].r) << row << ' ' << column << ' ' << level;
      balls += ball ? 1 : 0;
    }
  }
  EXPECT_GT(balls, 500);
}

// Mutations: a lens that draws the rows that it was asked for; rows drawn without their neighbours.
TEST_P(LensTest, RendersRowsAloneAsInTheWholePicture) {
  const vision::StereoRig rig = rig_with(GetParam().lens);
  worlds::World world = ball_at(rig, {0.9, -0.2, 2.0});
  world.walls = {{{1.0, -3.0}, {1.4, 3.0}, 3.1, worlds::Material::kPlain}};  // an edge across all columns
  Renderer renderer(world, rig);
  const slam::Pose pose{0.0, 0.0, 0.02};
  const StereoFrame whole = renderer.render(pose);
  for (int first = 0; first < 480; first += 5) {
    const cv::Range rows(first, first + 5);
    const StereoFrame alone = renderer.render(pose, pose, rows);
    EXPECT_EQ(cv::norm(alone.left.colour, whole.left.colour.rowRange(rows), cv::NORM_INF), 0.0) << rows.start;
    EXPECT_EQ(cv::norm(alone.right.colour, whole.right.colour.rowRange(rows), cv::NORM_INF), 0.0)
        << rows.start;
    EXPECT_EQ(cv::norm(alone.right.ball_id, whole.right.ball_id.rowRange(rows), cv::NORM_INF), 0.0)
        << rows.start;
    EXPECT_EQ(cv::norm(alone.left.depth_m != whole.left.depth_m.rowRange(rows)), 0.0) << rows.start;
  }
  for (const cv::Range none : {cv::Range(-1, 3), cv::Range(5, 5), cv::Range(470, 481)})
    EXPECT_THROW(renderer.render(pose, pose, none), std::invalid_argument) << none.start;
}

INSTANTIATE_TEST_SUITE_P(All, LensTest,
                         testing::Values(NamedLens{"pinhole", {}}, NamedLens{"barrel", kBarrel},
                                         NamedLens{"pincushion", kPincushion},
                                         NamedLens{"stretched", {.pixel_aspect = 0.85}}));

TEST(Lens, ThatFoldsItsPictureIsRefused) {
  EXPECT_THROW(Lens(rig_with({.k1 = -2.0})), std::invalid_argument);
  EXPECT_THROW(Lens(rig_with({.k1 = std::nan("")})), std::invalid_argument);
}

}  // namespace
}  // namespace stereobench::renderer
