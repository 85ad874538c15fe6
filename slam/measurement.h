/// How a landmark is seen: range and bearing of a point from a pose, and back.
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "slam/elementary.h"
#include "slam/motion.h"
#include "slam/types.h"

namespace stereobench::slam {

/// Range and bearing (m, rad) at which a point is seen: eq. 5 with atan2(dy, dx) - heading, wrapped.
///
/// @param robot world_from_robot
/// @param point_in_world m
/// @return (range >= 0, bearing in (-pi, pi]); at range 0 every bearing is as good, and -heading is returned
inline Eigen::Vector2d predict_sighting(const Pose& robot, const Eigen::Vector2d& point_in_world) {
  const double dx = point_in_world.x() - robot.x_m;
  const double dy = point_in_world.y() - robot.y_m;
  return {std::sqrt(dx * dx + dy * dy), wrap_angle(arc_tangent(dy, dx) - robot.heading_rad)};
}

/// The point in the world that is seen at a range and bearing: the inverse of predict_sighting.
inline Eigen::Vector2d locate(const Pose& robot, const Eigen::Vector2d& range_bearing) {
  const double direction_rad = robot.heading_rad + range_bearing.y();
  const auto [s, c] = sine_cosine(direction_rad);
  return {robot.x_m + range_bearing.x() * c, robot.y_m + range_bearing.x() * s};
}

/// d(range, bearing) / d(landmark x, y). From the landmark's own place the bearing has no slope: the range is
/// taken as at least a millimetre, and the direction as zero when there is none.
inline Eigen::Matrix2d sighting_by_landmark(const Pose& robot, const Eigen::Vector2d& point) {
  constexpr double kNearest_m = 1e-3;
  const double dx = point.x() - robot.x_m;
  const double dy = point.y() - robot.y_m;
  const double range = std::max(std::sqrt(dx * dx + dy * dy), kNearest_m);
  const double c = dx / range;
  const double s = dy / range;
  Eigen::Matrix2d slope;
  slope << c, s, -s / range, c / range;
  return slope;
}

/// The difference a - b of two sightings: the bearing is wrapped, the range is not.
inline Eigen::Vector2d sighting_residual(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return {a.x() - b.x(), wrap_angle(a.y() - b.y())};
}

/// @return whether a sighting can be used: finite, range >= 0, covariance symmetric and semidefinite
bool is_valid(const RangeBearing& sighting);

}  // namespace stereobench::slam
