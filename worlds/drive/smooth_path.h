/// Drives without corners: figure eights, curves through points, and what was driven before.
#pragma once

#include <filesystem>
#include <vector>

#include <Eigen/Core>

#include "worlds/drive/path.h"

namespace stereobench::worlds {

/// A smooth curve through points, at constant speed. At each point it heads as from the point before to the
/// point after (Catmull and Rom); between them lie biarcs.
struct SplinePath {
  std::vector<Eigen::Vector2d> points_m;
  bool closed = false;
  double speed_mps = 1.0;
  double step_s = 1.0;
  double odometry_s = 0.0;
};

/// A pose at a time.
struct TimedPose {
  double time_s = 0.0;
  slam::Pose pose;
};

/// A circle to the left, then one of the same size to the right; they touch at the start. Both are a lap.
/// @throws std::invalid_argument as drive_circle
GroundTruth drive_figure_eight(const CirclePath& path);

/// @throws std::invalid_argument as drive_polyline, but for corners
GroundTruth drive_spline(const SplinePath& path);

/// Drives through poses at their times, by biarcs, backwards where they go back; where they stay in a place,
/// or move to the side, the robot turns on the spot.
/// @param poses two at least, times ascending
/// @throws std::invalid_argument when times do not ascend, and as drive_circle
GroundTruth drive_recorded(const std::vector<TimedPose>& poses, double step_s, double odometry_s);

/// Reads a trajectory: TUM's `timestamp tx ty tz qx qy qz qw`, of which the heading is used, or our own
/// groundtruth.csv `t_s,x_m,y_m,theta_rad`. Lines that begin with # are comments.
/// @throws std::runtime_error, one line with file and line, for whatever is not exactly that
std::vector<TimedPose> read_trajectory(const std::filesystem::path& file);

}  // namespace stereobench::worlds
