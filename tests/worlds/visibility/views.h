/// What a drive sees of a world, found out a second time and in another way than
/// worlds/visibility/visibility.h does.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "slam/models/measurement.h"
#include "worlds/types.h"

namespace stereobench::worlds {

/// A ball as a camera has it: a disc in the image that holds the true outline. Written anew here, in the
/// plane and for level cameras only, so that a fault of vision or of the renderer cannot hide in it.
struct Disc {
  double u_px = 0.0;
  double v_px = 0.0;
  double radius_px = 0.0;
  double forward_m = 0.0;
};

inline Eigen::Vector2d camera_in_world(const slam::Pose& pose, double left_m) {
  return {pose.x_m - left_m * std::sin(pose.heading_rad), pose.y_m + left_m * std::cos(pose.heading_rad)};
}

inline std::optional<Disc> disc_of(const Ball& ball, const vision::StereoRig& rig, const slam::Pose& pose,
                                   double left_m) {
  const Eigen::Vector2d away = ball.centre_m.head<2>() - camera_in_world(pose, left_m);
  const double forward_m = away.x() * std::cos(pose.heading_rad) + away.y() * std::sin(pose.heading_rad);
  const double aside_m = -away.x() * std::sin(pose.heading_rad) + away.y() * std::cos(pose.heading_rad);
  if (forward_m < 3 * ball.radius_m) return std::nullopt;
  const vision::Intrinsics& camera = rig.intrinsics;
  const Disc disc = {camera.cx_px - camera.focal_px * aside_m / forward_m,
                     camera.cy_px - camera.focal_px * (ball.centre_m.z() - rig.height_m) / forward_m,
                     camera.focal_px * ball.radius_m / forward_m * 1.08 + 2.0, forward_m};
  const bool inside = disc.u_px > disc.radius_px && disc.u_px < camera.width_px - disc.radius_px &&
                      disc.v_px > disc.radius_px && disc.v_px < camera.height_px - disc.radius_px;
  return inside ? std::optional(disc) : std::nullopt;
}

inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

inline bool hidden_by(const Wall& wall, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const Eigen::Vector2d along = wall.to_m - wall.from_m;
  const Eigen::Vector2d sight = to - from;
  return cross(along, from - wall.from_m) * cross(along, to - wall.from_m) < 0 &&
         cross(sight, wall.from_m - from) * cross(sight, wall.to_m - from) < 0;
}

/// Whether no wall stands between a camera and the ball's middle or either of its sides.
inline bool clear_of_walls(const World& world, const Ball& ball, const Eigen::Vector2d& camera_m) {
  const Eigen::Vector2d sight = (ball.centre_m.head<2>() - camera_m).normalized();
  const Eigen::Vector2d side = Eigen::Vector2d(-sight.y(), sight.x()) * ball.radius_m;
  return std::ranges::none_of(world.walls, [&](const Wall& wall) {
    return hidden_by(wall, camera_m, ball.centre_m.head<2>() + side) ||
           hidden_by(wall, camera_m, ball.centre_m.head<2>() - side);
  });
}

/// The balls that a camera sees whole: not cut by the border, not behind a wall, not touched by a nearer
/// ball's disc.
inline std::vector<bool> whole_in_camera(const Scenario& scenario, const World& world, const slam::Pose& pose,
                                         double left_m) {
  std::vector<std::optional<Disc>> discs;
  for (const Ball& ball : world.balls) {
    const bool clear = clear_of_walls(world, ball, camera_in_world(pose, left_m));
    discs.push_back(clear ? disc_of(ball, scenario.rig, pose, left_m) : std::nullopt);
  }
  std::vector<bool> whole;
  for (const auto& disc : discs) {
    whole.push_back(disc && std::ranges::none_of(discs, [&](const auto& other) {
                      return other && other->forward_m < disc->forward_m &&
                             std::hypot(other->u_px - disc->u_px, other->v_px - disc->v_px) <
                                 other->radius_px + disc->radius_px;
                    }));
  }
  return whole;
}

/// What a whole drive sees of a world.
struct Views {
  std::vector<int> balls_in_view;  ///< for each step: whole in both cameras within the distance
  std::vector<int> steps_seen;     ///< for each ball
  double nearest_m = 1e9;
};

inline Views views_of(const Scenario& scenario, const World& world, double within_m) {
  Views views;
  views.steps_seen.resize(world.balls.size());
  for (const PathStep& step : scenario.path) {
    const auto left = whole_in_camera(scenario, world, step.pose, scenario.rig.baseline_m / 2);
    const auto right = whole_in_camera(scenario, world, step.pose, -scenario.rig.baseline_m / 2);
    int count = 0;
    for (std::size_t i = 0; i < world.balls.size(); ++i) {
      const double range_m = slam::predict_sighting(step.pose, world.balls[i].centre_m.head<2>()).x();
      if (!left[i] || !right[i] || range_m > within_m) continue;
      ++count;
      ++views.steps_seen[i];
      views.nearest_m = std::min(views.nearest_m, range_m);
    }
    views.balls_in_view.push_back(count);
  }
  return views;
}

}  // namespace stereobench::worlds
