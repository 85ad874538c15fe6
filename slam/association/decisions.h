/// What a filter decided about the sightings of its last update, for those who know the truth.
#pragma once

#include <span>
#include <vector>

#include "slam/association/sighting.h"

namespace stereobench::slam {

/// What became of one sighting. Sightings are numbered over all that a filter was ever given, from 0.
struct Decision {
  int sighting = kUnknown;
  Outcome outcome = Outcome::kAdd;
  int origin = kUnknown;  ///< the sighting that founded the landmark it was held against; kUnknown: none
};

/// Two landmarks that turned out to be one, by the sightings that founded them.
struct Merged {
  int kept = kUnknown;
  int dropped = kUnknown;
};

/// @return decisions as they stand once landmarks were merged: what was held against the dropped one, or
/// found it, is held against the one that was kept
std::vector<Decision> after_merging(std::span<const Decision> decisions, std::span<const Merged> merged);

/// The decisions of the last update by the particle that the frame left heaviest, and that particle's map.
struct Decisions {
  std::vector<Decision> sightings;  ///< those that could be used, in their order
  std::vector<int> mapped;          ///< origins of the landmarks it has after the update
};

/// @param origin_of (const Sighting&, const Target&): of the landmark that a target points at
template <class OriginOf>
std::vector<Decision> decisions_of(std::span<const Sighting> frame, std::span<const Target> targets,
                                   const OriginOf& origin_of) {
  std::vector<Decision> decisions;
  for (std::size_t k = 0; k < frame.size(); ++k) {
    const int origin = targets[k].landmark >= 0 ? origin_of(frame[k], targets[k]) : kUnknown;
    decisions.push_back({frame[k].number, targets[k].outcome, origin});
  }
  return decisions;
}

}  // namespace stereobench::slam
