/// Which poses of two trajectories are of the same instant.
#pragma once

#include "harness/trajectories/types.h"

namespace stereobench::harness {

struct PairingRules {
  double most_dt_s = 0.01;  ///< between the two stamps of a pair
  double offset_s = 0.0;    ///< is added to the stamps of the estimate
};

/// Gives each pose of the trajectory that has fewer (the estimate, of equals) the pose of the other that is
/// nearest in time, the earlier of two. Without stamps the n-th poses of both belong together.
///
/// @param estimate, truth with at least one pose each
/// @throws std::runtime_error, one line, where no two stamps are near; without stamps, where the numbers of
/// poses differ or there is an offset
TrajectoryPairs pair_trajectories(const Trajectory& estimate, const Trajectory& truth,
                                  const PairingRules& rules = {});

}  // namespace stereobench::harness
