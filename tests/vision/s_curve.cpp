#include "tests/vision/s_curve.h"

#include <algorithm>
#include <cmath>

#include "tests/vision/painter.h"
#include "vision/observe.h"
#include "vision/stereo/sphere.h"

namespace stereobench::vision::painter {
namespace {

constexpr double kRadius_m = 0.05;

// The ball whose outline has this centre in the left camera.
PaintedBall ball_at(const StereoRig& rig, const Eigen::Vector2d& centre_px, double depth_m, int colour) {
  const double f = rig.intrinsics.focal_px;
  const double per_metre = f * depth_m / (depth_m * depth_m - kRadius_m * kRadius_m);
  PaintedBall ball{{0.0, 0.0, depth_m}, colour, kRadius_m};
  ball.in_camera.x() = (centre_px.x() - rig.intrinsics.cx_px) / per_metre;
  ball.in_camera.y() = (centre_px.y() - rig.intrinsics.cy_px) / per_metre;
  return ball;
}

// One ball of each colour, all as far beside a column and a row of pixels.
Scene scene_at(const StereoRig& rig, const Eigen::Vector2d& phase_px, double depth_m) {
  Scene scene;
  scene.backdrop = Backdrop::kPlain;
  for (int i = 0; i < kSCurveBalls; ++i) {
    const Eigen::Vector2d place(130.0 + 75.0 * (i % 6), 70.0 + 120.0 * (i / 6));
    scene.balls.push_back(ball_at(rig, place + phase_px, depth_m, i));
  }
  return scene;
}

}  // namespace

PhaseErrors errors_at_phase(int phase, double radius_px) {
  StereoRig rig = rig_with_pictures_of(620, 380);
  rig.intrinsics.cx_px = 310.0;
  const double depth_m = kRadius_m * std::hypot(1.0, rig.intrinsics.focal_px / radius_px);
  const double phase_px = static_cast<double>(phase) / kPhases;
  const Scene scene = scene_at(rig, {phase_px, std::fmod(5.0 * phase_px + 0.37, 1.0)}, depth_m);
  PhaseErrors errors;
  for (const BallObservation& seen : observe(paint(scene, rig), rig, {})) {
    const PaintedBall& ball = scene.balls[static_cast<std::size_t>(seen.colour)];
    const auto left = sphere_outline(rig.intrinsics, ball.in_camera, kRadius_m);
    const auto right =
        sphere_outline(rig.intrinsics, ball.in_camera - Eigen::Vector3d(rig.baseline_m, 0.0, 0.0), kRadius_m);
    const double off_left = seen.left_px.x() - left->centre_px.x();
    const double off_right = seen.right_px.x() - right->centre_px.x();
    errors.left_px += off_left / kSCurveBalls;
    errors.disparity_px += (off_left - off_right) / kSCurveBalls;
    errors.radius_px = std::max({errors.radius_px, std::abs(seen.left_radius_px - left->radius_px()),
                                 std::abs(seen.right_radius_px - right->radius_px())});
    ++errors.found;
  }
  return errors;
}

}  // namespace stereobench::vision::painter
