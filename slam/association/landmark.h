/// A landmark of a map, and how it has fared.
#pragma once

#include <cstdint>
#include <limits>

#include <Eigen/Geometry>

#include "slam/models/belief.h"

namespace stereobench::slam {

/// How often a landmark was agreed with and contradicted. It stops counting where two bytes end, far beyond
/// what any decision asks for: a landmark then fills a cache line and no more.
struct TrackRecord {
  std::uint16_t uses = 1;      ///< sightings that agreed with it, the first included
  std::uint16_t refusals = 0;  ///< sightings since the last agreement that contradicted it

  void agree() {
    uses = one_more(uses);
    refusals = 0;
  }
  void contradict() { refusals = one_more(refusals); }

 private:
  static std::uint16_t one_more(std::uint16_t count) {
    return count < std::numeric_limits<std::uint16_t>::max() ? static_cast<std::uint16_t>(count + 1) : count;
  }
};

/// What is known of a landmark besides its place.
struct LandmarkStatus {
  int colour_class = kUnknown;
  TrackRecord record;
  int origin = kUnknown;  ///< the sighting that founded it
  float log_odds = 0.0F;  ///< that it exists at all
};

/// A landmark, given the path of the robot or not.
struct Landmark {
  LandmarkBelief belief;
  LandmarkStatus status;
};

/// What a group of landmarks keeps within.
struct LandmarkBounds {
  Eigen::AlignedBox2d places_m;      ///< of the means; empty for no landmark
  double largest_variance_m2 = 0.0;  ///< no landmark is more uncertain in any direction (trace of covariance)
};

}  // namespace stereobench::slam
