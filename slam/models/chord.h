/// A motion along and across its chord: the coordinates in which the error of a coarse control is Gaussian.
///
/// A control that is held for a while moves along the direction half way of its turn, and turns. Whatever its
/// errors are, it never moves across that direction. In (x, y, heading) the same errors lie on a curve.
#pragma once

#include <Eigen/Core>

#include "slam/models/belief.h"

namespace stereobench::slam {

/// A motion's chord (m along and across the direction half way of the turn, and the turn, rad) with its
/// covariance.
struct ChordBelief {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// A control moves nothing across its chord. Searches need some room there: this share of the step's standard
/// deviation.
inline constexpr double kAcrossShare = 1e-4;

/// The chord of a motion between two poses.
/// @param turn_rad from one to the other; it may be more than half a turn
Eigen::Vector3d chord_between(const Pose& from, const Pose& to, double turn_rad);

/// d chord / d(x, y, heading) of the pose at its end; that of its start differs in signs.
/// @param direction_rad of the chord, in the world
Eigen::Matrix3d chord_by_end(double direction_rad, const Eigen::Vector3d& chord);

/// The pose in which a motion ends.
Pose end_of(const Pose& from, const Eigen::Vector3d& chord);

/// d(x, y, heading) / d chord of the pose in which a motion ends.
Eigen::Matrix3d end_by_chord(const Pose& from, const Eigen::Vector3d& chord);

/// The velocities that move as a relative pose says, held for a while, with their covariance to first order.
/// @param start_from_end the motion in the frame of its start; it turns by less than a full turn. motion_of()
/// is the way back
/// @param duration_s > 0
Control control_of(const PoseBelief& start_from_end, double duration_s);

/// A motion in chord coordinates, to first order at its mean.
/// @param start_from_end the motion in the frame of its start
ChordBelief chord_of(const PoseBelief& start_from_end);

/// The same with some room across the chord, for searches.
ChordBelief chord_with_slack(const PoseBelief& start_from_end);

}  // namespace stereobench::slam
