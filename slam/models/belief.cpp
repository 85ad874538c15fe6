#include "slam/models/belief.h"

namespace stereobench::slam {
namespace {

/// T P T' for a turn T of x and y, whose result is as symmetric as P.
Eigen::Matrix3d turned(const Eigen::Matrix3d& p, SineCosine heading) {
  const auto [s, c] = heading;
  const double across = 2.0 * s * c * p(0, 1);
  const double xy = s * c * (p(0, 0) - p(1, 1)) + (c * c - s * s) * p(0, 1);
  const double x_heading = c * p(0, 2) - s * p(1, 2);
  const double y_heading = s * p(0, 2) + c * p(1, 2);
  Eigen::Matrix3d result;
  result << c * c * p(0, 0) - across + s * s * p(1, 1), xy, x_heading,  //
      xy, s * s * p(0, 0) + across + c * c * p(1, 1), y_heading,        //
      x_heading, y_heading, p(2, 2);
  return result;
}

}  // namespace

Eigen::Matrix<double, 2, 3> lever(const Pose& pose, const Eigen::Vector2d& point) {
  Eigen::Matrix<double, 2, 3> slope = Eigen::Matrix<double, 2, 3>::Identity();
  slope.col(2) = heading_lever(pose, point);
  return slope;
}

PoseBelief follow(const Pose& world_from_start, const PoseBelief& start_from_now) {
  return follow(world_from_start, sine_cosine(world_from_start.heading_rad), start_from_now);
}

PoseBelief follow(const Pose& world_from_start, SineCosine heading, const PoseBelief& start_from_now) {
  return {compose(world_from_start, heading, start_from_now.mean),
          turned(start_from_now.covariance, heading)};
}

PoseBelief follow(const PoseBelief& world_from_start, const PoseBelief& start_from_now) {
  PoseBelief now = follow(world_from_start.mean, start_from_now);
  now.covariance += with_heading_error(world_from_start.covariance,
                                       heading_lever(world_from_start.mean, {now.mean.x_m, now.mean.y_m}));
  return now;
}

PoseBelief after_drift(const PoseBelief& motion, const Pose& start, const Eigen::Matrix3d& drift) {
  const Pose turned_back{0.0, 0.0, -start.heading_rad};
  const PoseBelief in_its_frame{{}, follow(turned_back, PoseBelief{{}, drift}).covariance};
  return follow(in_its_frame, motion);
}

}  // namespace stereobench::slam
