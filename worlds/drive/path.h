/// Drives: from a shape on the floor to poses and the exact controls between them.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "slam/types.h"
#include "worlds/types.h"

namespace stereobench::worlds {

/// A circle that is driven counter-clockwise at constant speed.
struct CirclePath {
  slam::Pose start;  ///< the centre lies radius_m to the left of it
  double radius_m = 1.0;
  double speed_mps = 1.0;
  double laps = 1.0;        ///< > 0, need not be whole
  double step_s = 1.0;      ///< time between two instants
  double odometry_s = 0.0;  ///< time between two readings of the odometry; 0 = one for each instant
};

/// Straight pieces joined by tangent arcs, driven at constant speed.
struct PolylinePath {
  std::vector<Eigen::Vector2d> points_m;  ///< open: first and last are the ends; closed: all are corners
  bool closed = false;
  double corner_radius_m = 1.0;  ///< of the arc that rounds each corner
  double overlap_m = 0.0;        ///< closed: how much further to drive after the lap, at most another lap
  double speed_mps = 1.0;
  double step_s = 1.0;
  double odometry_s = 0.0;
};

/// Drives a circle. Step 0 is the start without controls.
///
/// @return steps `step_s` apart, the last one shorter if the drive's duration is no multiple of it
/// @throws std::invalid_argument when a size is not positive and finite, or the drive has too many steps or
///         readings
GroundTruth drive_circle(const CirclePath& path);

/// Drives a polyline. A closed one starts on its first edge, where the rounding of its first corner ends.
///
/// A step in which the robot passes from a straight to an arc holds a control for each, and where the
/// odometry is read more often, one for each reading; every pose is slam::advance over the controls since the
/// pose before, so noise-free odometry is exactly the truth.
///
/// @return steps `step_s` apart, the last one shorter if the drive's duration is no multiple of it
/// @throws std::invalid_argument when points coincide, the path turns back on itself, a corner does not fit
///         between its neighbours, a size is not positive and finite, or the drive has too many steps
///         or readings
GroundTruth drive_polyline(const PolylinePath& path);

/// Drives what controls say, one after another. Step 0 is the start without controls.
///
/// @return as above
/// @throws std::invalid_argument when there are too many steps or readings
GroundTruth drive_controls(const slam::Pose& start, std::vector<slam::Control> pieces, double step_s,
                           double odometry_s);

/// Where the robot is a little before or after a step, on its way.
///
/// @param index of the step, below path.size()
/// @param offset_s since the step, may be negative; beyond the drive's ends the robot stands still
slam::Pose pose_near(const GroundTruth& path, std::size_t index, double offset_s);

/// The length of a drive: the sum of |v| x duration over its controls, in metres.
double length_m(const GroundTruth& path);

}  // namespace stereobench::worlds
