/// A camera whose white balance is off: whether balls are still found, and for what they are.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/vision/painter.h"
#include "vision/camera/rig.h"
#include "vision/observe.h"

namespace stereobench::vision {
namespace {

/// A picture as a camera takes it whose channels' gains are off. @param gains of B, G, R
cv::Mat with_gains(const cv::Mat& picture, const cv::Scalar& gains) {
  cv::Mat result;
  cv::multiply(picture, gains, result);
  return result;
}

struct Tally {
  int balls = 0;
  int found = 0;    ///< where they are, whole and with their colour
  int strange = 0;  ///< whole observations that are of no ball, or of another colour
};

/// Scenes of all colours, each with gains at a corner of what is allowed: all eight in turn.
Tally look_with_gains_off_by(double share) {
  StereoRig rig;
  rig.intrinsics = {560, 420, 887.0, 279.5, 209.5};
  Tally tally;
  for (std::uint64_t seed = 0; seed < 16; ++seed) {
    painter::Scene scene;
    scene.balls = painter::scattered_balls(rig, 0.9, 6.0, seed);
    scene.noise_sd_levels = 2.0;
    scene.seed = seed;
    const auto gain = [&](std::uint64_t bit) { return (seed >> bit) % 2 == 0 ? 1.0 - share : 1.0 + share; };
    const cv::Scalar gains(gain(0), gain(1), gain(2));
    const StereoPair pair = painter::paint(scene, rig);
    const auto seen =
        observe({with_gains(pair.left, gains), with_gains(pair.right, gains)}, rig, {.noise_sd_levels = 2.0});
    const auto is_of = [](const BallObservation& observation, const painter::PaintedBall& ball) {
      return observation.trusted() && observation.colour == ball.colour &&
             (observation.ball_in_camera - ball.in_camera).norm() < 0.1 * ball.in_camera.z();
    };
    for (const painter::PaintedBall& ball : scene.balls) {
      ++tally.balls;
      tally.found += std::any_of(seen.begin(), seen.end(), [&](const auto& s) { return is_of(s, ball); });
    }
    for (const BallObservation& observation : seen)
      tally.strange +=
          observation.trusted() && std::none_of(scene.balls.begin(), scene.balls.end(),
                                                [&](const auto& b) { return is_of(observation, b); });
  }
  return tally;
}

// Mutation: colours told apart by a limit of 0.03 in chromaticity, in place of 0.11.
TEST(WhiteBalance, MayBeOffByFivePercent) {
  const Tally tally = look_with_gains_off_by(0.05);
  EXPECT_GE(tally.balls, 200);
  EXPECT_GE(tally.found, 0.99 * tally.balls);
  EXPECT_EQ(tally.strange, 0);
}

TEST(WhiteBalance, MayBeOffByTenPercent) {
  const Tally tally = look_with_gains_off_by(0.10);
  EXPECT_GE(tally.found, 0.95 * tally.balls);
  EXPECT_EQ(tally.strange, 0);
}

}  // namespace
}  // namespace stereobench::vision
