/// Trajectories in space, wherever they were made.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace stereobench::harness {

/// Where a body is in space: world_from_body.
struct PoseInSpace {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
};

PoseInSpace compose(const PoseInSpace& a, const PoseInSpace& b);

/// @return the pose of `to` in the frame of `from`
PoseInSpace between(const PoseInSpace& from, const PoseInSpace& to);

/// @return the angle of a rotation, rad, in [0, pi]
double angle_of(const Eigen::Matrix3d& rotation);

/// Poses in order of time.
struct Trajectory {
  std::vector<PoseInSpace> poses;
  std::vector<std::int64_t> stamps_ns;  ///< one a pose, rising; empty where the file has none
  bool is_planar = false;               ///< the file has x, y and a heading alone
};

/// Poses of an estimate and of the truth at the same instants.
struct TrajectoryPairs {
  std::vector<PoseInSpace> estimate;
  std::vector<PoseInSpace> truth;
  std::vector<std::int64_t> stamps_ns;  ///< of the truth; empty where there are none
  long repeated = 0;                    ///< pairs that share a pose with the pair before
  bool is_planar = false;               ///< of either
};

/// When each pair is: seconds from the first one; its number where there are no stamps.
std::vector<double> times_of(const TrajectoryPairs& pairs);

}  // namespace stereobench::harness
