/// Which poses of two trajectories are of the same instant.
#pragma once

#include "harness/trajectories/types.h"

namespace stereobench::harness {

struct PairingRules {
  double most_dt_s = 0.01;  ///< between the two stamps of a pair
  double offset_s = 0.0;    ///< is added to the stamps of the estimate
};

/// Gives each pose of the trajectory that has fewer the pose of the other that is nearest in time. Without
/// stamps the n-th poses of both belong together.
///
/// @throws std::runtime_error, one line, when no two stamps are near, or there are no stamps and the
///         trajectories have not as many poses
TrajectoryPairs pair_trajectories(const Trajectory& estimate, const Trajectory& truth,
                                  const PairingRules& rules = {});

}  // namespace stereobench::harness
