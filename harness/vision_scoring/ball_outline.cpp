#include "harness/vision_scoring/ball_outline.h"

#include <algorithm>

#include "renderer/truth/ball_truth.h"
#include "slam/math/angles.h"
#include "slam/math/elementary.h"
#include "vision/camera/distortion.h"
#include "vision/camera/rig.h"

namespace stereobench::harness {

namespace {

constexpr double kWholeFraction = 0.95;  // that is seen of a ball that is called whole

using vision::OutlineEllipse;
using vision::Side;

Eigen::Vector3d in_robot(const slam::Pose& world_from_robot, const Eigen::Vector3d& point_in_world) {
  const double dx = point_in_world.x() - world_from_robot.x_m;
  const double dy = point_in_world.y() - world_from_robot.y_m;
  const auto [s, c] = slam::sine_cosine(world_from_robot.heading_rad);
  return {c * dx + s * dy, c * dy - s * dx, point_in_world.z()};
}

Eigen::Vector2d point_on(const OutlineEllipse& ellipse, double turn_rad) {
  const auto [s, c] = slam::sine_cosine(ellipse.angle_rad);
  const auto [sine, cosine] = slam::sine_cosine(turn_rad);
  const Eigen::Vector2d major(c, s);
  const Eigen::Vector2d minor(-s, c);
  return ellipse.centre_px + ellipse.semi_major_px * cosine * major + ellipse.semi_minor_px * sine * minor;
}

/// Whether the picture that a rig takes holds all of an outline.
/// @param seen its directions_seen()
bool lies_inside(const vision::StereoRig& rig, const std::optional<Eigen::AlignedBox2d>& seen,
                 const OutlineEllipse& ellipse) {
  constexpr int kPoints = 64;
  if (rig.distortion == vision::Distortion{}) return vision::lies_inside(rig.intrinsics, ellipse);
  for (int i = 0; i < kPoints; ++i) {
    const Eigen::Vector3d ray =
        vision::pixel_ray(rig.intrinsics, point_on(ellipse, 2.0 * slam::kPi * i / kPoints));
    if (!seen || !seen->contains(ray.head<2>())) return false;  // beyond, the lens may fold
    if (!vision::is_inside(rig.intrinsics, vision::image_point(rig, ray))) return false;
  }
  return true;
}

/// The area that a rig's picture shows of an outline with nothing in its way, to first order in the lens.
double whole_area_px(const vision::StereoRig& rig, const OutlineEllipse& ellipse) {
  const Eigen::Vector2d direction = vision::pixel_ray(rig.intrinsics, ellipse.centre_px).head<2>();
  return slam::kPi * ellipse.semi_major_px * ellipse.semi_minor_px *
         vision::distortion_slope(rig.distortion, direction).determinant();
}

}  // namespace

bool contains(const OutlineEllipse& ellipse, const Eigen::Vector2d& pixel_px) {
  const Eigen::Vector2d offset = pixel_px - ellipse.centre_px;
  const auto [s, c] = slam::sine_cosine(ellipse.angle_rad);
  const double along = (c * offset.x() + s * offset.y()) / ellipse.semi_major_px;
  const double across = (c * offset.y() - s * offset.x()) / ellipse.semi_minor_px;
  return along * along + across * across <= 1.0;
}

bool is_whole(const BallInPair& ball) {
  return ball.inside_both && std::min(ball.left_fraction, ball.right_fraction) >= kWholeFraction;
}

std::vector<BallInPair> ball_outlines(const VisionTruth& truth) {
  const vision::Intrinsics& camera = truth.rig.intrinsics;
  const Eigen::Isometry3d camera_from_robot = vision::robot_from_camera(truth.rig).inverse();
  const auto left_ids = renderer::pixels_by_id(truth.frame.left.ball_id);
  const auto right_ids = renderer::pixels_by_id(truth.frame.right.ball_id);
  const auto seen = vision::directions_seen(truth.rig.distortion, camera);
  std::vector<BallInPair> outlines;
  for (std::size_t i = 0; i < truth.world.balls.size(); ++i) {
    const worlds::Ball& ball = truth.world.balls[i];
    const Eigen::Vector3d ball_in_robot = in_robot(truth.world_from_robot, ball.centre_m);
    const Eigen::Vector3d in_left = camera_from_robot * ball_in_robot;
    const Eigen::Vector3d in_right = vision::camera_point(truth.rig, in_left, Side::kRight);
    const auto left = vision::sphere_outline(camera, in_left, ball.radius_m);
    const auto right = vision::sphere_outline(camera, in_right, ball.radius_m);
    if (!left || !right) continue;
    BallInPair outline{static_cast<int>(i), ball_in_robot, *left, *right};
    outline.left_fraction = static_cast<double>(left_ids.at(i + 1).count) / whole_area_px(truth.rig, *left);
    outline.right_fraction =
        static_cast<double>(right_ids.at(i + 1).count) / whole_area_px(truth.rig, *right);
    outline.inside_both = lies_inside(truth.rig, seen, *left) && lies_inside(truth.rig, seen, *right);
    outlines.push_back(outline);
  }
  return outlines;
}

}  // namespace stereobench::harness
