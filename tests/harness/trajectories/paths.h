/// Paths in space for tests.
#pragma once

#include <cmath>

#include <Eigen/Geometry>

#include "harness/trajectories/types.h"
#include "slam/math/random.h"

namespace stereobench::harness {

inline Eigen::Matrix3d turned(double angle_rad, const Eigen::Vector3d& axis) {
  return Eigen::AngleAxisd(angle_rad, axis.normalized()).toRotationMatrix();
}

// A winding path; stamps are 0.1 s apart.
inline Trajectory winding_path(int poses = 200) {
  Trajectory path;
  for (int i = 0; i < poses; ++i) {
    const double t = 0.1 * i;
    path.stamps_ns.push_back(1'000'000'000'000'000'000 + 100'000'000LL * i);
    path.poses.push_back({turned(0.3 * t, {0.1 * std::sin(t), 0.2, 1.0}),
                          {5.0 * std::sin(0.4 * t), 3.0 * t, 2.0 * std::cos(0.7 * t)}});
  }
  return path;
}

// The same with an error of its own at every pose.
inline Trajectory disturbed(Trajectory path, double sd_m, double sd_rad, std::uint64_t seed) {
  slam::RandomStream random(seed, slam::Stream::kOdometry);
  const auto vector = [&] { return Eigen::Vector3d(random.normal(), random.normal(), random.normal()); };
  for (PoseInSpace& pose : path.poses) {
    pose.position_m += sd_m * vector();
    pose.rotation = pose.rotation * turned(sd_rad * random.normal(), vector());
  }
  return path;
}

}  // namespace stereobench::harness
