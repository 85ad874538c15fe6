/// Where the random numbers of a drive come from.
#pragma once

#include <cstdint>

namespace stereobench::harness {

/// The seeds of a drive, one for each part that is left to chance. A run has one seed for all; a study of
/// where the spread comes from holds some and changes others.
struct StreamSeeds {
  std::uint64_t world = 0;     ///< places, colours and materials
  std::uint64_t odometry = 0;  ///< its noise, and that of the start
  std::uint64_t sensor = 0;    ///< noise of pixels or of the oracle, lateness, faults of the detector
  std::uint64_t filter = 0;    ///< particles

  StreamSeeds() = default;
  /// The same seed for all. Implicit: a seed is all of them.
  StreamSeeds(std::uint64_t all) : world(all), odometry(all), sensor(all), filter(all) {}

  bool operator==(const StreamSeeds&) const = default;
};

}  // namespace stereobench::harness
