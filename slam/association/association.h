/// Which landmark of its colour a sighting belongs to, when colours repeat.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "slam/association/sighting.h"

namespace stereobench::slam {

/// A pair of sighting and landmark that may belong together.
struct Candidate {
  int sighting = 0;   ///< index within the frame
  int landmark = 0;   ///< index within the particle's map
  double cost = 0.0;  ///< minus twice the log likelihood; the smaller the better
  bool gated =
      false;  ///< beyond the gate, and a candidate only because nothing else of its colour can be near
  bool loose = false;  ///< so uncertain to each other that other landmarks may well be as near
};

/// Decides for each sighting of a frame, best pair first; a landmark is given to one sighting only.
///
/// A pair within the gate goes before one beyond it. A sighting without candidates is a new landmark. One
/// that lost all its candidates is new too, unless they were so near that no other landmark of its colour can
/// be there: then it is a double of the sighting that won.
///
/// @param candidates all pairs, in any order; sorted on return
/// @param near_excludes whether the colour spacing is known, so that every candidate excludes a new landmark
/// @param targets by sighting, kAdd where a decision is wanted; becomes kUse with its landmark, kAdd or
/// kIgnore
void assign(std::vector<Candidate>& candidates, bool near_excludes, std::span<Target> targets);

/// @param order receives the sightings that correct the pose, those of the oldest landmarks first
void order_by_age(std::span<const Target> targets, std::vector<std::size_t>& order);

}  // namespace stereobench::slam
