/// A drive's log before anything is sensed.
#pragma once

#include <cstdint>

#include "harness/types.h"
#include "worlds/types.h"

namespace stereobench::harness {

/// The log of a drive without sightings: landmarks, true poses, and odometry with its noise.
/// @param seed of the odometry's noise
MeasurementLog log_without_sightings(const worlds::Scenario& scenario, const worlds::World& world,
                                     std::uint64_t seed);

}  // namespace stereobench::harness
