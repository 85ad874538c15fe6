/// How a landmark is seen: range and bearing of a point from a pose, and back.
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "slam/math/elementary.h"
#include "slam/models/motion.h"
#include "slam/types.h"

namespace stereobench::slam {

/// Length and direction (m, rad) of a vector; the direction of none is 0.
inline Eigen::Vector2d polar(const Eigen::Vector2d& d) {
  return {std::sqrt(d.x() * d.x() + d.y() * d.y()), arc_tangent(d.y(), d.x())};
}

/// The same of two vectors, to the last bit; a column each.
inline Eigen::Matrix2d polar(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d x(a.x(), b.x());
  const Eigen::Vector2d y(a.y(), b.y());
  const auto [of_a, of_b] = arc_tangents({y[0], y[1]}, {x[0], x[1]});
  Eigen::Matrix2d result;
  result.row(0) = (x.cwiseProduct(x) + y.cwiseProduct(y)).cwiseSqrt();
  result.row(1) << of_a, of_b;
  return result;
}

/// Range and bearing (m, rad) at which a point is seen: eq. 5 with atan2(dy, dx) - heading, wrapped.
///
/// @param robot world_from_robot
/// @param point_in_world m
/// @return (range >= 0, bearing in (-pi, pi]); at range 0 every bearing is as good, and -heading is returned
inline Eigen::Vector2d predict_sighting(const Pose& robot, const Eigen::Vector2d& point_in_world) {
  Eigen::Vector2d seen = polar({point_in_world.x() - robot.x_m, point_in_world.y() - robot.y_m});
  seen.y() = wrap_angle(seen.y() - robot.heading_rad);
  return seen;
}

/// A place from which a point is seen.
struct View {
  Pose robot;             ///< world_from_robot
  Eigen::Vector2d point;  ///< in the world, m
};

/// Range and bearing of two views, to the last bit those of predict_sighting; a column each.
inline Eigen::Matrix2d predict_sightings(const View& a, const View& b) {
  Eigen::Matrix2d seen = polar({a.point.x() - a.robot.x_m, a.point.y() - a.robot.y_m},
                               {b.point.x() - b.robot.x_m, b.point.y() - b.robot.y_m});
  seen.row(1) << wrap_angle(seen(1, 0) - a.robot.heading_rad), wrap_angle(seen(1, 1) - b.robot.heading_rad);
  return seen;
}

/// The point in the world that is seen at a range and bearing: the inverse of predict_sighting.
inline Eigen::Vector2d locate(const Pose& robot, const Eigen::Vector2d& range_bearing) {
  const double direction_rad = robot.heading_rad + range_bearing.y();
  const auto [s, c] = sine_cosine(direction_rad);
  return {robot.x_m + range_bearing.x() * c, robot.y_m + range_bearing.x() * s};
}

/// A predicted sighting, and its slopes in what it is predicted from.
struct LinearSighting {
  Eigen::Vector2d expected;     ///< of predict_sighting
  Eigen::Matrix2d by_landmark;  ///< d(range, bearing) / d(landmark x, y)

  /// d(range, bearing) / d(robot x, y, heading)
  Eigen::Matrix<double, 2, 3> by_pose() const {
    Eigen::Matrix<double, 2, 3> slope;
    slope.leftCols<2>() = -by_landmark;
    slope.col(2) << 0.0, -1.0;
    return slope;
  }
};

/// Predicts a sighting to first order. From the landmark's own place the bearing has no slope: for the slopes
/// the range is taken as at least a millimetre, and the direction as zero when there is none.
///
/// @param robot world_from_robot
/// @param point_in_world m
inline LinearSighting linearise_sighting(const Pose& robot, const Eigen::Vector2d& point_in_world) {
  constexpr double kNearest_m = 1e-3;
  const double dx = point_in_world.x() - robot.x_m;
  const double dy = point_in_world.y() - robot.y_m;
  const double range = std::sqrt(dx * dx + dy * dy);
  const double nearness = 1.0 / std::max(range, kNearest_m);
  const double c = dx * nearness;
  const double s = dy * nearness;
  LinearSighting sighting{{range, wrap_angle(arc_tangent(dy, dx) - robot.heading_rad)}, {}};
  sighting.by_landmark << c, s, -s * nearness, c * nearness;
  return sighting;
}

/// The difference a - b of two sightings: the bearing is wrapped, the range is not.
inline Eigen::Vector2d sighting_residual(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return {a.x() - b.x(), wrap_angle(a.y() - b.y())};
}

/// @return whether a sighting can be used: finite, range >= 0, covariance symmetric and semidefinite
bool is_valid(const RangeBearing& sighting);

}  // namespace stereobench::slam
