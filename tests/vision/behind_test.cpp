// A near ball before another: what is behind its rim is round and shaded, and not the colour that is beside
// it.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/vision/painter.h"
#include "vision/camera/rig.h"
#include "vision/observe.h"
#include "vision/stereo/sphere.h"

namespace stereobench::vision {
namespace {

using painter::Dice;
using painter::PaintedBall;
using painter::Scene;

// A ball some 95 px in radius, and one that stands behind it and shows a crescent.
Scene pair_of_balls(std::uint64_t seed) {
  Dice dice(7000 + seed);
  const double depth = dice.uniform(0.42, 0.5);
  const double angle = dice.uniform(0.0, 6.28);
  const Eigen::Vector3d near(0.04 + dice.uniform(-0.01, 0.01), dice.uniform(-0.02, 0.02), depth);
  const Eigen::Vector3d beside(0.05 * std::cos(angle), 0.05 * std::sin(angle), 0.1);
  const int colour = static_cast<int>(dice.uniform(0.0, 18.0));
  const int other = (colour + 1 + static_cast<int>(dice.uniform(0.0, 17.0))) % 18;
  Scene scene;
  scene.balls = {{near, colour}, {near + beside, other}};
  scene.backdrop = painter::Backdrop::kPlain;
  scene.towards_light_source = {dice.uniform(-1.0, 1.0), dice.uniform(-1.0, 0.3), dice.uniform(-1.0, 0.2)};
  return scene;
}

double disparity_error_px(const BallObservation& seen, const PaintedBall& ball, const StereoRig& rig) {
  const auto column = [&](Side side) {
    return sphere_outline(rig.intrinsics, camera_point(rig, ball.in_camera, side), ball.radius_m)
        ->centre_px.x();
  };
  return seen.left_px.x() - seen.right_px.x() - (column(Side::kLeft) - column(Side::kRight));
}

// Without noise but as if there were some: what is left is what the colours behind the rim are taken for.
// Mutation: they are taken for those beside it, however these change (0.0015 px).
TEST(BallBeforeBall, IsMeasuredByTheColoursBehindItsRim) {
  const StereoRig rig = painter::rig_with_pictures_of(640, 400);
  ObserverSettings settings;
  settings.noise_sd_levels = 2.0;
  constexpr int kScenes = 60;
  int measured = 0;
  double squares = 0.0;
  for (std::uint64_t seed = 0; seed < kScenes; ++seed) {
    const Scene scene = pair_of_balls(seed);
    for (const BallObservation& seen : observe(painter::paint(scene, rig), rig, settings)) {
      if (seen.colour != scene.balls[0].colour || !seen.trusted()) continue;
      const double error = disparity_error_px(seen, scene.balls[0], rig);
      squares += error * error;
      ++measured;
    }
  }
  EXPECT_EQ(measured, kScenes);
  EXPECT_LT(std::sqrt(squares / measured), 0.001);
}

}  // namespace
}  // namespace stereobench::vision
