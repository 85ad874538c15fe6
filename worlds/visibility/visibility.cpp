#include "worlds/visibility/visibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "slam/math/elementary.h"
#include "slam/models/measurement.h"
#include "worlds/visibility/occluders.h"
#include "worlds/visibility/view_cone.h"

namespace stereobench::worlds {
namespace {

/// Whether a sphere's outline lies between two pixels along one axis of the picture: its extent there is that
/// of a circle in the plane of that axis and the line of sight, whose tangents from the camera bound it.
bool fits_between(double focal_px, double aside_m, double ahead_m, double radius_m, double low_px,
                  double high_px) {
  const double denominator = ahead_m * ahead_m - radius_m * radius_m;
  const double root = radius_m * std::sqrt(aside_m * aside_m + denominator);
  return focal_px * (aside_m * ahead_m - root) / denominator >= low_px &&
         focal_px * (aside_m * ahead_m + root) / denominator <= high_px;
}

bool fits_picture(const CameraPose& camera, const Eigen::Vector3d& in_camera, double radius_m) {
  const vision::Intrinsics& k = camera.intrinsics;
  const double edge_px = kBorder_px - 0.5;
  return fits_between(k.focal_px, in_camera.x(), in_camera.z(), radius_m, edge_px - k.cx_px,
                      k.width_px - 1.0 - edge_px - k.cx_px) &&
         fits_between(k.focal_px * camera.pixel_aspect, in_camera.y(), in_camera.z(), radius_m,
                      edge_px - k.cy_px, k.height_px - 1.0 - edge_px - k.cy_px);
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Whether a wall meets the floor plan of the cone from the camera to the ball. A wall that is lower than
/// both the camera and the ball's underside hides nothing.
bool hides(const Wall& wall, const CameraPose& camera, const Eigen::Vector3d& centre_m, double radius_m) {
  if (wall.height_m <= std::min(camera.centre_m.z(), centre_m.z() - radius_m)) return false;
  const Eigen::Vector2d from = camera.centre_m.head<2>();
  const Eigen::Vector2d sight = centre_m.head<2>() - from;
  const Eigen::Vector2d side = Eigen::Vector2d(-sight.y(), sight.x()).stableNormalized() * radius_m;
  const std::array<Eigen::Vector2d, 3> corners = {from, from + sight + side, from + sight - side};
  for (std::size_t i = 0; i < 3; ++i)
    if (segments_meet(corners[i], corners[(i + 1) % 3], wall.from_m, wall.to_m)) return true;
  return false;
}

/// The cone of a ball that is before the camera.
std::optional<Cone> cone_of(const CameraPose& camera, const Ball& ball, double radius_m) {
  if ((camera.camera_from_world * ball.centre_m).z() <= radius_m) return std::nullopt;
  return cone_around(camera, {ball.centre_m, radius_m});
}

bool is_large(const CameraPose& camera, const Cone& cone, const Ball& ball, double slack_m) {
  return camera.intrinsics.focal_px * ball.radius_m >= kLeastRadius_px * (cone.distance_m + slack_m);
}

/// For each ball whether the camera sees all of it.
std::vector<bool> seen_whole(const CameraPose& camera, const World& world, const Occluders& occluders,
                             double slack_m) {
  std::vector<std::optional<Cone>> cones;
  for (const Ball& ball : world.balls) cones.push_back(cone_of(camera, ball, ball.radius_m + slack_m));
  std::vector<std::optional<Cone>> shapes;
  for (const Sphere& sphere : spheres_around_shapes(world)) shapes.push_back(cone_around(camera, sphere));
  const auto is_seen = [&](std::size_t i) {
    const Ball& ball = world.balls[i];
    const double radius_m = ball.radius_m + slack_m;
    if (!cones[i] || !is_large(camera, *cones[i], ball, slack_m)) return false;
    if (!fits_picture(camera, camera.camera_from_world * ball.centre_m, radius_m)) return false;
    const auto in_front = [&](const std::optional<Cone>& other) {
      return other && other->distance_m < cones[i]->distance_m && overlap(*other, *cones[i]);
    };
    const auto before = [&](const std::optional<Cone>& shape) { return hides(shape, *cones[i]); };
    return std::ranges::none_of(cones, in_front) && std::ranges::none_of(shapes, before) &&
           std::ranges::none_of(
               world.walls, [&](const Wall& wall) { return hides(wall, camera, ball.centre_m, radius_m); }) &&
           !occluders.meet(visibility_volume(camera.centre_m, {ball.centre_m, ball.radius_m}, slack_m));
  };
  std::vector<bool> seen;
  for (std::size_t i = 0; i < world.balls.size(); ++i) seen.push_back(is_seen(i));
  return seen;
}

bool in_sector(const OracleSensor& sensor, const slam::Pose& pose, const Ball& ball, double slack_m) {
  const Eigen::Vector2d sighting = slam::predict_sighting(pose, ball.centre_m.head<2>());
  const double slack_rad = slack_m > 0.0 ? slam::arc_tangent(slack_m, sighting.x() - slack_m) : 0.0;
  return sighting.x() + slack_m <= sensor.max_range_m &&
         std::abs(sighting.y()) + slack_rad <= sensor.field_of_view_rad / 2.0;
}

}  // namespace

ViewSector view_sector(const vision::StereoRig& rig, double ball_radius_m) {
  const vision::Intrinsics& camera = rig.intrinsics;
  return {camera.focal_px * ball_radius_m / kLeastRadius_px,
          slam::arc_tangent(0.5 * camera.width_px, camera.focal_px)};
}

bool segments_meet(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                   const Eigen::Vector2d& d) {
  const auto sides_differ = [](const Eigen::Vector2d& p, const Eigen::Vector2d& q, const Eigen::Vector2d& r,
                               const Eigen::Vector2d& s) {
    return cross(q - p, r - p) * cross(q - p, s - p) <= 0.0;
  };
  return sides_differ(a, b, c, d) && sides_differ(c, d, a, b);
}

std::vector<int> balls_in_view(const Scenario& scenario, const World& world,
                               const slam::Pose& world_from_robot, double slack_m) {
  std::vector<int> in_view;
  const bool stereo = scenario.sensor == SensorKind::kStereo;
  std::vector<bool> left, right;
  if (stereo) {
    const Occluders occluders(world);
    left = seen_whole(camera_pose(scenario.rig, vision::Side::kLeft, world_from_robot), world, occluders,
                      slack_m);
    right = seen_whole(camera_pose(scenario.rig, vision::Side::kRight, world_from_robot), world, occluders,
                       slack_m);
  }
  for (std::size_t i = 0; i < world.balls.size(); ++i) {
    const bool seen =
        stereo ? left[i] && right[i] : in_sector(scenario.oracle, world_from_robot, world.balls[i], slack_m);
    if (seen) in_view.push_back(static_cast<int>(i));
  }
  return in_view;
}

double distance_m(const Eigen::Vector2d& point_m, const Wall& wall) {
  const Eigen::Vector2d along = wall.to_m - wall.from_m;
  const double share = std::clamp((point_m - wall.from_m).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (wall.from_m + share * along - point_m).norm();
}

}  // namespace stereobench::worlds
