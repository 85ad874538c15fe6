/// Balls before balls, pixel by pixel: each over what is behind it, by the share that it has of the pixel
/// when it is alone.
///
/// Mutations seen red here: all balls drawn at once; in two layers at most; near to far.

#include <array>
#include <utility>

#include <gtest/gtest.h>

#include "renderer/renderer.h"
#include "tests/renderer/random_scene.h"
#include "vision/camera/rig.h"

namespace stereobench::renderer {
namespace {

/// The channel in which a ball is as bright as can be: its share of a pixel can be read off there.
struct Paint {
  Eigen::Vector3d rgb;
  int channel;  ///< of blue, green, red
};
const std::array<Paint, 3> kPaints = {{{{1.0, 0.2, 0.1}, 2}, {{0.1, 1.0, 0.3}, 1}, {{0.2, 0.3, 1.0}, 0}}};

const Paint& paint_of(std::size_t index) {
  return kPaints[index % kPaints.size()];
}

/// Balls of 12 to 40 px in each other's way, the farthest first, under light that falls on all alike.
std::vector<worlds::Ball> crowd(const vision::StereoRig& rig, std::uint64_t seed) {
  slam::RandomStream random(seed, slam::Stream::kWorld, 11);
  std::vector<worlds::Ball> balls;
  for (std::size_t i = 0; i < 9; ++i) {
    const double depth_m = 5.0 - 0.5 * static_cast<double>(i);
    const Eigen::Vector2d pixel(test::between(random, 150.0, 260.0), test::between(random, 110.0, 200.0));
    const double radius_m = test::between(random, 12.0, 40.0) * depth_m / rig.intrinsics.focal_px;
    balls.push_back({vision::robot_from_camera(rig) * (depth_m * vision::pixel_ray(rig.intrinsics, pixel)),
                     std::min(radius_m, 0.24), 0, paint_of(i).rgb});
  }
  return balls;
}

cv::Mat left_of(std::vector<worlds::Ball> balls) {
  cv::Mat colour;
  Renderer(test::flat_sky(std::move(balls)), test::rig_looking_up())
      .render({})
      .left.colour.convertTo(colour, CV_32F);
  return colour;
}

/// Each ball alone, put over those behind it.
cv::Mat put_together(const std::vector<worlds::Ball>& balls) {
  cv::Mat together = left_of({balls.front()});
  for (std::size_t i = 1; i < balls.size(); ++i) {
    const cv::Mat one = left_of({balls[i]});
    cv::Mat share;
    cv::extractChannel(one, share, paint_of(i).channel);
    cv::merge(std::vector<cv::Mat>(3, cv::Mat(1.0 - share / 255.0)), share);
    together = one + share.mul(together);
  }
  return together;
}

class Overlap : public testing::TestWithParam<std::uint64_t> {};

TEST_P(Overlap, EachBallIsOverThoseBehindItByItsShare) {
  std::vector<worlds::Ball> balls = crowd(test::rig_looking_up(), GetParam());
  const cv::Mat expected = put_together(balls);
  std::swap(balls.front(), balls[4]);  // whatever their order in the world
  EXPECT_LE(cv::norm(left_of(balls), expected, cv::NORM_INF), 4.0) << "half a level for each ball";
}

INSTANTIATE_TEST_SUITE_P(Seeds, Overlap, testing::Range(std::uint64_t{0}, std::uint64_t{6}));

}  // namespace
}  // namespace stereobench::renderer
