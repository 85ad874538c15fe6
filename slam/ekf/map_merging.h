/// Landmarks that were found twice, told by the map as a whole.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "slam/association/landmark.h"
#include "slam/association/policy.h"
#include "slam/ekf/joint_belief.h"

namespace stereobench::slam {

/// A landmark beside its place.
struct LandmarkSeen {
  int slot = kUnknown;
  LandmarkStatus status;
  int first_ago = 0;  ///< frames since it was seen first
  int last_ago = 0;   ///< and since it was seen last
};

/// @return whether it may have been found twice: it has no identity, and is not dead
inline bool may_be_double(int slot, const LandmarkStatus& status) {
  return slot == kUnknown && !Existence::is_dead(status.log_odds);
}

/// Looks for older landmarks in the places of recent ones.
///
/// What was seen of late hangs together by odometry over a short way. It is laid over the old map as a whole,
/// as a frame is laid over the map (keep_joint), with the density of landmarks on the ground for those that
/// have no partner. A pair that is loose, or competes with another, stays two where it has less than 99.9 %
/// among all ways to do this, or where what was seen fits elsewhere too.
///
/// @param seen the landmarks of the belief, in their order
/// @param recent within so many frames
/// @param shown how many landmarks a look shows
/// @param cut incremented when the search took too many steps
/// @return pairs (old landmark, recent landmark), each landmark once
std::vector<std::pair<int, int>> find_doubles(const AssociationPolicy& policy, const JointBelief& belief,
                                              std::span<const LandmarkSeen> seen, int recent,
                                              std::size_t shown, long& cut);

}  // namespace stereobench::slam
