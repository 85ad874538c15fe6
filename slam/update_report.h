/// What an update of a filter says of the filter itself.
#pragma once

#include <vector>

namespace stereobench::slam {

/// How far a sighting was from what the filter expected, in units of how uncertain it said to be.
///
/// The prediction is the one from before the sighting was used, but after those of its frame that were used
/// before it; of a filter that is right, the squared lengths are then independent and chi-square distributed
/// with two degrees of freedom.
struct NormalisedInnovation {
  int sighting = 0;             ///< index within the sightings that the update was given
  double squared_length = 0.0;  ///< v' S^-1 v (NIS)
  bool refused = false;         ///< did not correct the pose; with particles: those of half of the weight
};

/// What the last update found. Empty unless FilterConfig::report_updates asks for it.
struct UpdateReport {
  /// One for each sighting of a landmark that was in the map, in the order in which they were used.
  std::vector<NormalisedInnovation> innovations;

  /// For each particle the index of the particle that it descends from, as the update found them; empty when
  /// particles were not resampled.
  std::vector<int> ancestors;
};

}  // namespace stereobench::slam
