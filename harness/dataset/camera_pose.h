/// Where the cameras of a drive are in the world.
#pragma once

#include <string>

#include <Eigen/Geometry>

#include "harness/dataset/dataset_drive.h"

namespace stereobench::harness {

/// A robot's pose in space. @return world_from_robot, metres
Eigen::Isometry3d world_from_robot(const slam::Pose& pose);

/// Where a camera was when it took its picture.
/// @param step has pictures
/// @return world_from_camera, metres; the camera frame is x right, y down, z forward
Eigen::Isometry3d world_from_camera(const DatasetDrive& drive, std::size_t step, vision::Side side);

/// The same rotation has two quaternions. @return the one with w >= 0
Eigen::Quaterniond unit_quaternion(const Eigen::Matrix3d& rotation);

/// A line of a trajectory file of TUM: seconds, x y z, qx qy qz qw.
std::string tum_line(std::int64_t stamp_ns, const Eigen::Isometry3d& pose);

/// A 3 x 4 or 4 x 4 matrix, row by row, with blanks or commas between its numbers.
std::string matrix_text(const Eigen::Isometry3d& pose, int rows, const char* separator);

}  // namespace stereobench::harness
