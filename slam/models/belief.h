/// What a particle believes: Gaussians of its pose and of each landmark, and what it expects to see.
#pragma once

#include <Eigen/Core>

#include "slam/math/elementary.h"
#include "slam/models/motion.h"
#include "slam/types.h"

namespace stereobench::slam {

/// A pose with its covariance over (x, y, heading); singular where nothing is uncertain.
struct PoseBelief {
  Pose mean;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// A landmark's place in the world, given the particle's path.
struct LandmarkBelief {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
};

/// A sighting as the models read it; the noise carries its floor already. Read it through noise_at().
struct Observation {
  Eigen::Vector2d range_bearing = Eigen::Vector2d::Zero();
  Eigen::Matrix2d noise = Eigen::Matrix2d::Zero();  ///< the part that does not grow with the range
  double range_sd_per_m2 = 0.0;                     ///< what grows: sd of a range per square of it, 1/m
};

/// What a landmark should look like from an uncertain pose: moments of the sighting before it is used.
struct PredictedMeasurement {
  Eigen::Vector2d expected = Eigen::Vector2d::Zero();    ///< range, bearing
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< S: pose, landmark and sensor together
  Eigen::Matrix<double, 3, 2> cross = Eigen::Matrix<double, 3, 2>::Zero();  ///< of pose and sighting
};

/// The mean of poses moved by a small vector (dx, dy, dheading).
inline Pose boxplus(const Pose& pose, const Eigen::Vector3d& step) {
  return {pose.x_m + step.x(), pose.y_m + step.y(), wrap_angle(pose.heading_rad + step.z())};
}

/// The vector (dx, dy, dheading) from one pose to another, the heading wrapped.
inline Eigen::Vector3d boxminus(const Pose& to, const Pose& from) {
  return {to.x_m - from.x_m, to.y_m - from.y_m, wrap_angle(to.heading_rad - from.heading_rad)};
}

/// How far a point that is fixed to the robot swings when its heading is off by a little, m/rad.
inline Eigen::Vector2d heading_lever(const Pose& pose, const Eigen::Vector2d& point) {
  return {-(point.y() - pose.y_m), point.x() - pose.x_m};
}

/// T P T' for a pose whose errors in x and y grow by swing times that of its heading.
inline Eigen::Matrix3d with_heading_error(const Eigen::Matrix3d& covariance,
                                          const Eigen::Vector2d& heading_lever) {
  Eigen::Matrix3d half;  // T P
  for (int j = 0; j < 3; ++j)
    half.col(j) =
        covariance.col(j) + covariance(2, j) * Eigen::Vector3d(heading_lever.x(), heading_lever.y(), 0.0);
  Eigen::Matrix3d result;
  for (int j = 0; j < 2; ++j) result.col(j) = half.col(j) + heading_lever[j] * half.col(2);
  result.col(2) = half.col(2);
  return result;
}

/// How a small error of a pose (x, y, heading) shifts a point that is fixed to the robot.
///
/// @param pose world_from_robot
/// @param point in the world
Eigen::Matrix<double, 2, 3> lever(const Pose& pose, const Eigen::Vector2d& point);

/// Puts a relative motion behind a pose that is known exactly.
///
/// Rotating and shifting a Gaussian is linear, so this loses nothing: motion in the plane does not depend on
/// where it happens, and the motion since the last update can be predicted once for all particles.
PoseBelief follow(const Pose& world_from_start, const PoseBelief& start_from_now);

/// The same where the sine and cosine of the pose's heading are at hand.
PoseBelief follow(const Pose& world_from_start, SineCosine heading, const PoseBelief& start_from_now);

/// Puts a relative motion behind an uncertain pose, to first order in the pose's uncertainty.
PoseBelief follow(const PoseBelief& world_from_start, const PoseBelief& start_from_now);

/// The motion of a control that states its covariance (of a control's velocities), to first order.
PoseBelief motion_of(const Control& control);

/// Moves a belief by one control; one that is not valid is ignored and counted.
///
/// @param model of moments, with move()
template <class Model>
void move(PoseBelief& belief, const Model& model, const Control& control, const OdometryNoise& noise,
          FilterCounters& counters) {
  if (!is_valid(control)) {
    ++counters.rejected_inputs;
    return;
  }
  if (control.covariance) {
    belief = follow(belief, motion_of(control));
    return;
  }
  const Eigen::Vector2d control_sd = standard_deviations(control, noise);
  belief = model.move(belief, control, control_sd, counters.covariance_repairs);
}

/// A motion whose start has drifted.
///
/// @param motion in the robot's frame of its start
/// @param start world_from_robot
/// @param drift covariance of (x, y, heading) of the start, in the world
PoseBelief after_drift(const PoseBelief& motion, const Pose& start, const Eigen::Matrix3d& drift);

}  // namespace stereobench::slam
