/// Things scattered beside a drive: clutter, and what could be taken for a ball.
#pragma once

#include <string>
#include <vector>

#include "worlds/generate/keyed_sampler.h"
#include "worlds/types.h"

namespace stereobench::worlds {

/// Puts a scenario's distractors and clutter into a seed's world. Each thing stands on the floor, clear of
/// the drive, walls, meshes, balls and other things, with no wall and no mesh between it and the drive, and
/// hides no more balls than `balls_in_view` leaves.
///
/// @param world its balls in their places, its meshes of files with their occluders
/// @param draws where all that is drawn goes; of a place's attempts, the last
/// @return names of the things for which no place was found; they are not there
std::vector<std::string> scatter(const Scenario& scenario, World& world, KeyedSampler& draws);

}  // namespace stereobench::worlds
