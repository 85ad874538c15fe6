#include "tests/vision/hidden_scenes.h"

#include <algorithm>
#include <cmath>

#include "vision/camera/rig.h"

namespace stereobench::vision::painter {
namespace {

// Where the line of sight of the middle of the cameras to a point passes a depth.
Eigen::Vector3d on_the_way(const StereoRig& rig, const Eigen::Vector3d& to, double depth_m) {
  const Eigen::Vector3d from(0.5 * rig.baseline_m, 0.0, 0.0);
  return from + (to - from) * (depth_m / to.z());
}

// A grey wall with an upright or level edge that is at most 0.9 radii from the ball's centre.
Panel wall_before(const PaintedBall& ball, const StereoRig& rig, Dice& dice) {
  const double depth = ball.in_camera.z() * dice.uniform(0.5, 0.9);
  const Eigen::Vector3d middle = on_the_way(rig, ball.in_camera, depth);
  const double edge = dice.uniform(-0.9, 0.9) * kHiddenRadius_m * depth / ball.in_camera.z();
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
  const double aside = dice.uniform(0.2, 0.95) * kHiddenRadius_m * (1.0 + share);
  const Eigen::Vector3d middle =
      on_the_way(rig, ball.in_camera, depth) + aside * Eigen::Vector3d(std::cos(turn), std::sin(turn), 0.0);
  const int other = (ball.colour + 1 + static_cast<int>(dice.uniform(0.0, 17.0))) % 18;
  return {middle, other};
}

// Across one of the borders of the camera that is nearer to it.
PaintedBall at_border(const StereoRig& rig, double depth_m, Dice& dice) {
  const Intrinsics& camera = rig.intrinsics;
  const double radius = camera.focal_px * kHiddenRadius_m / depth_m;
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

}  // namespace

StereoRig rig_of_hidden_balls() {
  return rig_with_pictures_of(512, 384);
}

Scene hidden_scene(Hider hider, const StereoRig& rig, std::uint64_t seed) {
  Dice dice(1000 * static_cast<std::uint64_t>(hider) + seed);
  Scene scene;
  scene.noise_sd_levels = kHiddenNoise_levels;
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

bool is_partly_hidden(double visible_share) {
  return visible_share >= 0.3 && visible_share <= 0.9;
}

Eigen::Vector2d range_bearing_error(const BallObservation& seen, const PaintedBall& ball,
                                    const StereoRig& rig) {
  const Eigen::Vector3d in_robot = robot_from_camera(rig) * ball.in_camera;
  return {seen.range_bearing.range_m - std::hypot(in_robot.x(), in_robot.y()),
          seen.range_bearing.bearing_rad - std::atan2(in_robot.y(), in_robot.x())};
}

double allowed_range_error_m(double depth_m) {
  return 0.005 * std::pow(std::max(1.0, depth_m / 3.0), 2.5);
}

}  // namespace stereobench::vision::painter
