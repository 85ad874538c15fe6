// The S-curve: how the error of a centre goes with where it lies between the pixels.
#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "painter.h"
#include "vision/observe.h"
#include "vision/sphere.h"

namespace stereobench::vision {
namespace {

using painter::PaintedBall;
using painter::Scene;

constexpr int kPhases = 16;
constexpr int kColours = 18;
constexpr double kRadius_m = 0.05;

// The ball whose outline has this centre in the left eye.
PaintedBall ball_at(const StereoRig& rig, const Eigen::Vector2d& centre_px, double depth_m, int colour) {
  const double f = rig.camera.focal_px;
  const double per_metre = f * depth_m / (depth_m * depth_m - kRadius_m * kRadius_m);
  PaintedBall ball{{0.0, 0.0, depth_m}, colour, kRadius_m};
  ball.in_camera.x() = (centre_px.x() - rig.camera.cx_px) / per_metre;
  ball.in_camera.y() = (centre_px.y() - rig.camera.cy_px) / per_metre;
  return ball;
}

// One ball of each colour, all as far beside a column and a row of pixels.
Scene scene_at(const StereoRig& rig, const Eigen::Vector2d& phase_px, double depth_m) {
  Scene scene;
  scene.backdrop = painter::Backdrop::kPlain;
  for (int i = 0; i < kColours; ++i) {
    const Eigen::Vector2d place(130.0 + 75.0 * (i % 6), 70.0 + 120.0 * (i / 6));
    scene.balls.push_back(ball_at(rig, place + phase_px, depth_m, i));
  }
  return scene;
}

struct Errors {
  double left_px = 0.0;  // of all colours, mean
  double disparity_px = 0.0;
  double radius_px = 0.0;  // largest of any
};

Errors errors_at(const StereoRig& rig, const Eigen::Vector2d& phase_px, double depth_m) {
  const Scene scene = scene_at(rig, phase_px, depth_m);
  Errors errors;
  int found = 0;
  for (const BallObservation& seen : observe(painter::paint(scene, rig), rig, {})) {
    const PaintedBall& ball = scene.balls[static_cast<std::size_t>(seen.colour)];
    const auto left = sphere_outline(rig.camera, ball.in_camera, kRadius_m);
    const auto right =
        sphere_outline(rig.camera, ball.in_camera - Eigen::Vector3d(rig.baseline_m, 0.0, 0.0), kRadius_m);
    const double off_left = seen.left_px.x() - left->centre_px.x();
    const double off_right = seen.right_px.x() - right->centre_px.x();
    errors.left_px += off_left / kColours;
    errors.disparity_px += (off_left - off_right) / kColours;
    errors.radius_px = std::max({errors.radius_px, std::abs(seen.left_radius_px - left->radius_px()),
                                 std::abs(seen.right_radius_px - right->radius_px())});
    ++found;
  }
  EXPECT_EQ(found, kColours);
  return errors;
}

class SubPixel : public testing::TestWithParam<double> {};

// Eighteen colours without noise: what is left is the whole levels of their pixels, some 0.001 px a ball, and
// what the fit itself has wrong. Mutations: pixels taken whole; a pixel's corner taken for a whole strip of
// it.
TEST_P(SubPixel, TheSCurveIsFlat) {
  StereoRig rig = painter::rig_with_pictures_of(620, 380);
  rig.camera.cx_px = 310.0;
  const double radius_px = GetParam();
  const double depth_m = kRadius_m * std::hypot(1.0, rig.camera.focal_px / radius_px);
  double lowest = 1.0, highest = -1.0;
  for (int i = 0; i < kPhases; ++i) {
    const double phase = static_cast<double>(i) / kPhases;
    const Errors errors = errors_at(rig, {phase, std::fmod(5.0 * phase + 0.37, 1.0)}, depth_m);
    EXPECT_LT(std::abs(errors.left_px), 0.003) << "phase " << phase;
    EXPECT_LT(std::abs(errors.disparity_px), 0.003) << "phase " << phase;
    EXPECT_LT(errors.radius_px, 0.1) << "phase " << phase;
    lowest = std::min(lowest, errors.left_px);
    highest = std::max(highest, errors.left_px);
  }
  EXPECT_LT(highest - lowest, 0.003);
}
INSTANTIATE_TEST_SUITE_P(Radii, SubPixel, testing::Values(6.0, 12.0, 25.0));

}  // namespace
}  // namespace stereobench::vision
