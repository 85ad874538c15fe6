#include "slam/belief.h"

#include <cmath>

#include "slam/elementary.h"
#include "slam/motion.h"

namespace stereobench::slam {

Pose displace(const Pose& pose, const Eigen::Vector3d& step) {
  return {pose.x_m + step.x(), pose.y_m + step.y(), wrap_angle(pose.heading_rad + step.z())};
}

Eigen::Vector3d displacement(const Pose& to, const Pose& from) {
  return {to.x_m - from.x_m, to.y_m - from.y_m, wrap_angle(to.heading_rad - from.heading_rad)};
}

Eigen::Matrix<double, 2, 3> lever(const Pose& pose, const Eigen::Vector2d& point) {
  Eigen::Matrix<double, 2, 3> slope = Eigen::Matrix<double, 2, 3>::Identity();
  slope.col(2) << -(point.y() - pose.y_m), point.x() - pose.x_m;
  return slope;
}

PoseBelief follow(const Pose& world_from_start, const PoseBelief& start_from_now) {
  const auto [s, c] = sine_cosine(world_from_start.heading_rad);
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() << c, -s, s, c;
  const Eigen::Matrix3d covariance = turn * start_from_now.covariance * turn.transpose();
  return {compose(world_from_start, start_from_now.mean), 0.5 * (covariance + covariance.transpose())};
}

PoseBelief follow(const PoseBelief& world_from_start, const PoseBelief& start_from_now) {
  PoseBelief now = follow(world_from_start.mean, start_from_now);
  Eigen::Matrix3d by_start = Eigen::Matrix3d::Identity();
  by_start.topRows<2>() = lever(world_from_start.mean, {now.mean.x_m, now.mean.y_m});
  now.covariance += by_start * world_from_start.covariance * by_start.transpose();
  return now;
}

}  // namespace stereobench::slam
