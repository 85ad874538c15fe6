/// How far and how well a sensor sees that nobody describes, by its own sightings.
#pragma once

#include <span>

#include "slam/filter_config.h"
#include "slam/reference/batch.h"

namespace stereobench::slam {

/// Looks that a sensor's rates were counted over: three frames that follow each other.
struct LookCounts {
  long triples = 0;       ///< sightings that must be within the sector in the two frames that follow
  long once = 0;          ///< of these: with a sighting in their place in the next frame
  long twice = 0;         ///< and in the one after it too
  long after_a_miss = 0;  ///< with none in the next frame, and one in the frame after it
};

/// What a log says of its sensor.
struct FoundSector {
  SensorSector sector;  ///< none is declared (range 0) where the log has too few sightings to tell
  LookCounts looks;
};

/// Finds the sector of a sensor and its rates from sightings without identities.
///
/// The sector begins at the robot, lies to both sides alike, and ends where 99.9 % of the sightings lie
/// within it. The rates follow from how often a sighting is found again. With a share c of sightings of
/// nothing, a landmark that was seen is seen in the next frame with d, and in the one after a miss with 1 -
/// q:
///
///     P(next) = (1 - c) d,   P(both) = (1 - c) d^2,   P(the second alone) = (1 - c) (1 - d) (1 - q)
///
/// What hides a landmark lasts, so that q may be larger than 1 - d. Each miss is then taken for one of many:
/// the probability of a miss is the larger of the two, 0.9 at most.
///
/// @param config as filters are told: the noise by which sightings of two frames are compared
/// @param steps those that show nothing without an identity are no looks
FoundSector find_sector(const FilterConfig& config, std::span<const BatchStep> steps);

}  // namespace stereobench::slam
