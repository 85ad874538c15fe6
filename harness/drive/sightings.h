/// From what a detector found to what filters are given.
#pragma once

#include <span>
#include <vector>

#include "slam/types.h"
#include "vision/types.h"
#include "worlds/oracle.h"
#include "worlds/types.h"

namespace stereobench::harness {

using worlds::Sightings;

/// Turns observations into the measurements that filters are given: all that are trusted.
///
/// Where identities are known, a colour is an identity: the index of the ball that has it. A colour that no
/// ball has is an identity as well, the number of balls plus the colour, since a robot does not know which
/// colours the world holds: what a detector imagines reaches the filters. An observation without a colour has
/// no identity then and is left out.
/// @param observations of one pair
/// @param balls_observed the true ball of each observation, by index, or kUnknown
/// @param balls of the world; read for their colours alone
Sightings sightings_of(std::span<const vision::BallObservation> observations,
                       std::span<const int> balls_observed, std::span<const worlds::Ball> balls,
                       worlds::Identity identity);

/// Tells the landmark of each sighting that is of one. Those of nothing stay as they are.
void tell_names(Sightings& sightings);

}  // namespace stereobench::harness
