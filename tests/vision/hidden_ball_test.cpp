// Balls of which a part is hidden by a wall's edge, by a nearer ball, or lies beyond the picture's border:
// they are measured by what is left of their outlines, and what they claim of it holds.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "painter.h"
#include "slam/gaussian.h"
#include "vision/observe.h"
#include "vision/palette.h"
#include "vision/rig.h"

namespace stereobench::vision {
namespace {

using painter::Dice;
using painter::PaintedBall;
using painter::Panel;
using painter::Scene;

constexpr double kRadius_m = 0.05;
constexpr double kNoise_levels = 2.0;

enum class Hider { kEdge, kBall, kBorder };

StereoRig small_rig() {
  return painter::rig_with_pictures_of(512, 384);
}

// Where the line of sight of the middle of the eyes to a point passes a depth.
Eigen::Vector3d on_the_way(const StereoRig& rig, const Eigen::Vector3d& to, double depth_m) {
  const Eigen::Vector3d from(0.5 * rig.baseline_m, 0.0, 0.0);
  return from + (to - from) * (depth_m / to.z());
}

// A grey wall with an upright or level edge that is at most 0.9 radii from the ball's centre.
Panel wall_before(const PaintedBall& ball, const StereoRig& rig, Dice& dice) {
  const double depth = ball.in_camera.z() * dice.uniform(0.5, 0.9);
  const Eigen::Vector3d middle = on_the_way(rig, ball.in_camera, depth);
  const double edge = dice.uniform(-0.9, 0.9) * kRadius_m * depth / ball.in_camera.z();
  Panel wall{depth, middle.x() - 1.0, middle.x() + 1.0, middle.y() - 1.0, middle.y() + 1.0};
  const int side = static_cast<int>(dice.uniform(0.0, 4.0));
  if (side == 0) wall.max_x_m = middle.x() + edge;
  if (side == 1) wall.min_x_m = middle.x() + edge;
  if (side == 2) wall.max_y_m = middle.y() + edge;
  if (side == 3) wall.min_y_m = middle.y() + edge;
  const double grey = dice.uniform(80.0, 220.0);
  for (double& channel : wall.bgr) channel = grey * dice.uniform(0.9, 1.1);
  return wall;
}

PaintedBall ball_before(const PaintedBall& ball, const StereoRig& rig, Dice& dice) {
  const double depth = ball.in_camera.z() * dice.uniform(0.5, 0.95);
  const double share = depth / ball.in_camera.z();
  const double turn = dice.uniform(0.0, 6.28);
  const double aside = dice.uniform(0.2, 0.95) * kRadius_m * (1.0 + share);
  const Eigen::Vector3d middle =
      on_the_way(rig, ball.in_camera, depth) + aside * Eigen::Vector3d(std::cos(turn), std::sin(turn), 0.0);
  const int other = (ball.colour + 1 + static_cast<int>(dice.uniform(0.0, 17.0))) % 18;
  return {middle, other};
}

// Across one of the borders of the eye that is nearer to it.
PaintedBall at_border(const StereoRig& rig, double depth_m, Dice& dice) {
  const Intrinsics& camera = rig.camera;
  const double radius = camera.focal_px * kRadius_m / depth_m;
  const double inwards = dice.uniform(-0.9, 0.9) * radius;
  const double disparity = camera.focal_px * rig.baseline_m / depth_m;
  Eigen::Vector2d pixel(dice.uniform(disparity + 2 * radius, camera.width_px - 2 * radius),
                        dice.uniform(2 * radius, camera.height_px - 2 * radius));
  const int side = static_cast<int>(dice.uniform(0.0, 4.0));
  if (side == 0) pixel.x() = disparity + inwards;
  if (side == 1) pixel.x() = camera.width_px - inwards;
  if (side == 2) pixel.y() = inwards;
  if (side == 3) pixel.y() = camera.height_px - inwards;
  return {pixel_ray(camera, pixel) * depth_m, static_cast<int>(dice.uniform(0.0, 18.0))};
}

Scene hidden_scene(Hider hider, const StereoRig& rig, std::uint64_t seed) {
  Dice dice(1000 * static_cast<std::uint64_t>(hider) + seed);
  Scene scene;
  scene.noise_sd_levels = kNoise_levels;
  scene.seed = seed;
  const double depth = dice.uniform(1.0, 4.0);
  if (hider == Hider::kBorder) {
    scene.balls = {at_border(rig, depth, dice)};
    return scene;
  }
  const Eigen::Vector3d place(dice.uniform(-0.1, 0.2), dice.uniform(-0.1, 0.1), 1.0);
  scene.balls = {{place * depth, static_cast<int>(dice.uniform(0.0, 18.0))}};
  if (hider == Hider::kEdge) scene.panels = {wall_before(scene.balls[0], rig, dice)};
  if (hider == Hider::kBall) scene.balls.push_back(ball_before(scene.balls[0], rig, dice));
  return scene;
}

// The error of range and bearing.
Eigen::Vector2d error_of(const BallObservation& seen, const PaintedBall& ball, const StereoRig& rig) {
  const Eigen::Vector3d in_robot = robot_from_camera(rig) * ball.in_camera;
  return {seen.range_bearing.range_m - std::hypot(in_robot.x(), in_robot.y()),
          seen.range_bearing.bearing_rad - std::atan2(in_robot.y(), in_robot.x())};
}

class HiddenBalls : public testing::TestWithParam<Hider> {};

// NIS / 2 of n balls scatters by 1 / sqrt(n), when those that filters refuse are left out: at most one in
// thirty. Errors below a millimetre are below any rig's calibration, whatever is claimed. Mutations: no
// second try from the patch's boundary; the right eye on the wrong side; arcs that contradict each other by a
// fifth of a pixel all believed.
TEST_P(HiddenBalls, AreMeasuredByWhatIsLeftOfThem) {
  const StereoRig rig = small_rig();
  ObserverSettings settings;
  settings.noise_sd_levels = kNoise_levels;
  int wide = 0, found_wide = 0, measured = 0, refused = 0;
  const double gate = slam::chi_square_2_quantile(0.9999);
  double nis = 0.0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    const Scene scene = hidden_scene(GetParam(), rig, seed);
    const double visible = painter::visible_share(scene, rig, 0);
    if (visible < 0.3 || visible > 0.9) continue;
    const PaintedBall& ball = scene.balls[0];
    const bool is_wide = painter::visible_arc_deg(scene, rig, 0) >= 150.0;
    wide += is_wide ? 1 : 0;
    for (const BallObservation& seen : observe(painter::paint(scene, rig), rig, settings)) {
      if (seen.colour != ball.colour || !seen.trusted()) continue;
      found_wide += is_wide ? 1 : 0;
      ++measured;
      const Eigen::Vector2d error = error_of(seen, ball, rig);
      const Eigen::Matrix2d& covariance = seen.range_bearing.covariance;
      const double distance2 = error.dot(covariance.inverse() * error);
      if (distance2 > gate) {
        ++refused;
      } else {
        nis += distance2 / 2.0;
      }
      const double scale = std::pow(std::max(1.0, ball.in_camera.z() / 3.0), 2.5);
      EXPECT_LT(std::abs(error.x()), 0.005 * scale) << "seed " << seed << " visible " << visible;
      EXPECT_LT(std::abs(error.x()), std::max(0.001, 5.0 * std::sqrt(covariance(0, 0)))) << "seed " << seed;
    }
  }
  ASSERT_GT(wide, 40);
  EXPECT_GE(found_wide, 0.9 * wide);
  EXPECT_LE(30 * refused, measured);
  EXPECT_NEAR(nis / (measured - refused), 1.0, 0.3 + 3.0 / std::sqrt(measured));
}

// A wall as high as a sliver of the ball, which pulls the outline where the first look puts it: two of 120
// may be left to distrust. Mutation: arcs that may not be at odds from the first sharp look on.
TEST(HiddenSlivers, LeaveTheBallToBeFound) {
  const StereoRig rig = small_rig();
  ObserverSettings settings;
  settings.noise_sd_levels = kNoise_levels;
  int found = 0;
  for (std::uint64_t seed = 0; seed < 120; ++seed) {
    Dice dice(5000 + seed);
    const double depth = dice.uniform(1.5, 3.0);
    const Eigen::Vector3d place(dice.uniform(-0.1, 0.2), dice.uniform(-0.1, 0.1), 1.0);
    Scene scene;
    scene.noise_sd_levels = kNoise_levels;
    scene.seed = seed;
    scene.balls = {{place * depth, static_cast<int>(dice.uniform(0.0, 18.0))}};
    const double top = place.y() * depth + dice.uniform(0.85, 0.97) * kRadius_m;
    scene.panels = {{0.99 * depth, -2.0, 2.0, 0.99 * top, 2.0, {120.0, 150.0, 130.0}}};
    for (const BallObservation& seen : observe(painter::paint(scene, rig), rig, settings)) {
      if (seen.colour != scene.balls[0].colour || !seen.trusted()) continue;
      ++found;
      EXPECT_LT(std::abs(error_of(seen, scene.balls[0], rig).x()), 0.005) << "seed " << seed;
    }
  }
  EXPECT_GE(found, 118);
  EXPECT_LE(found, 120);
}

std::string name_of(const testing::TestParamInfo<Hider>& hider) {
  if (hider.param == Hider::kEdge) return "ByAnEdge";
  return hider.param == Hider::kBall ? "ByABall" : "ByTheBorder";
}

INSTANTIATE_TEST_SUITE_P(All, HiddenBalls, testing::Values(Hider::kEdge, Hider::kBall, Hider::kBorder),
                         name_of);

}  // namespace
}  // namespace stereobench::vision
