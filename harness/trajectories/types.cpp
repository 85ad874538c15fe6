#include "harness/trajectories/types.h"

#include "harness/types.h"
#include "slam/math/elementary.h"

namespace stereobench::harness {

PoseInSpace compose(const PoseInSpace& a, const PoseInSpace& b) {
  return {a.rotation * b.rotation, a.position_m + a.rotation * b.position_m};
}

PoseInSpace between(const PoseInSpace& from, const PoseInSpace& to) {
  const Eigen::Matrix3d back = from.rotation.transpose();
  return {back * to.rotation, back * (to.position_m - from.position_m)};
}

double angle_of(const Eigen::Matrix3d& rotation) {
  const Eigen::Vector3d axis(rotation(2, 1) - rotation(1, 2), rotation(0, 2) - rotation(2, 0),
                             rotation(1, 0) - rotation(0, 1));
  return slam::arc_tangent(axis.norm(), rotation.trace() - 1.0);
}

std::vector<double> times_of(const TrajectoryPairs& pairs) {
  std::vector<double> times;
  for (std::size_t i = 0; i < pairs.truth.size(); ++i)
    times.push_back(pairs.stamps_ns.empty()
                        ? static_cast<double>(i)
                        : static_cast<double>(pairs.stamps_ns[i] - pairs.stamps_ns.front()) /
                              static_cast<double>(kSecond_ns));
  return times;
}

}  // namespace stereobench::harness
