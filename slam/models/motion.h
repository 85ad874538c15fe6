/// How a robot moves in the plane: poses, velocities held for a while, and the odometry's noise.
#pragma once

#include <cmath>

#include <Eigen/Core>

#include "slam/math/angles.h"
#include "slam/math/elementary.h"
#include "slam/math/random.h"
#include "slam/types.h"

namespace stereobench::slam {

/// Brings an angle into (-pi, pi].
inline double wrap_angle(double angle_rad) {
  if (angle_rad > -kPi && angle_rad <= kPi) return angle_rad;
  const double wrapped = std::remainder(angle_rad, 2.0 * kPi);
  return wrapped <= -kPi ? kPi : wrapped;
}

/// Moves a pose along the arc of a control: eq. 4 put right.
///
/// The chord has length v dt sinc(w dt / 2) and direction heading + w dt / 2, and so has that of the lateral
/// speed a quarter of a turn further. This is exact for constant velocities and needs no division by w: half
/// a step plus half a step is a step, and w = 0 is nothing special.
Pose advance(const Pose& pose, const Control& control);

/// The product of two poses: a_from_c = a_from_b * b_from_c.
Pose compose(const Pose& a_from_b, const Pose& b_from_c);

/// The same where the sine and cosine of a_from_b's heading are at hand.
Pose compose(const Pose& a_from_b, SineCosine heading, const Pose& b_from_c);

/// The pose b_from_a of a_from_b.
Pose inverse(const Pose& a_from_b);

/// The standard deviations (m/s, rad/s) of a control's velocities (eq. 3, read as standard deviations).
///
/// They hold for the control as a whole, and controls are independent of each other. A control that is
/// shorter than noise.correlation_s gets sqrt(correlation_s / duration_s) times as much: over that time the
/// path then spreads as if one error had lasted, however finely the odometry is divided.
Eigen::Vector2d standard_deviations(const Control& control, const OdometryNoise& noise);

/// Draws what the odometry would have reported for a true control, or the reverse: two normals, v then w.
Control perturb(const Control& control, const OdometryNoise& noise, RandomStream& random);

/// @return whether the control can be used: finite numbers and a duration that is not negative
bool is_valid(const Control& control);

}  // namespace stereobench::slam
