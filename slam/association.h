/// Which landmark of its colour a sighting belongs to, when colours repeat.
#pragma once

#include <vector>

#include "slam/belief.h"

namespace stereobench::slam {

/// A landmark without identity of its own: one of several of its colour.
struct ClassedLandmark {
  LandmarkBelief belief;
  int colour_class = kUnknown;
};

inline constexpr int kNewLandmark = -1;  ///< a sighting of something that is not in the map yet
inline constexpr int kNoLandmark = -2;   ///< a sighting that is refused

/// A pair of sighting and landmark that may belong together.
struct Candidate {
  int sighting = 0;    ///< index within the frame
  int landmark = 0;    ///< index within the particle's map
  double cost = 0.0;   ///< minus log likelihood; the smaller the better
  bool gated = false;  ///< beyond the gate, and a candidate only because nothing else of its colour can be near
};

/// Decides for each sighting of a frame, best pair first; a landmark is given to one sighting only.
///
/// A pair within the gate goes before one beyond it. A sighting without candidates is a new landmark. One that lost
/// all its candidates is new too, unless one of them was so near that no other landmark of its colour can be
/// there: then it is a double of the sighting that won, and belongs to nothing.
///
/// @param candidates all pairs, in any order; sorted on return
/// @param targets by sighting: kNewLandmark where a decision is wanted; becomes a landmark, kNewLandmark or
/// kNoLandmark
/// @param near_excludes whether the colour spacing is known, so that every candidate excludes a new landmark
void assign(std::vector<Candidate>& candidates, bool near_excludes, int* targets);

}  // namespace stereobench::slam
