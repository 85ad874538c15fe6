/// Trajectories in files that other programs write.
#pragma once

#include <filesystem>

#include "harness/trajectories/types.h"

namespace stereobench::harness {

/// Reads a trajectory, plain or gzip. What its first row looks like says which format it is:
/// - TUM: `time x y z qx qy qz qw`, seconds, separated by blanks;
/// - EuRoC: `time,x,y,z,qw,qx,qy,qz`, nanoseconds, separated by commas; further columns are left out;
/// - KITTI: the first three rows of the pose's matrix, 12 numbers separated by blanks, without a time;
/// - ours: `t_s,x_m,y_m,theta_rad` below that header, as in groundtruth.csv: poses in the plane.
///
/// But for ours, lines that begin with `#` are comments.
/// @throws std::runtime_error, one line with file and line, for anything else, for a rotation that is none,
/// where time does not rise, and for a file without poses
Trajectory read_trajectory(const std::filesystem::path& file);

}  // namespace stereobench::harness
