/// A scenario's world as one seed has it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "worlds/generate/keyed_sampler.h"
#include "worlds/types.h"

namespace stereobench::worlds {

/// A world, and what was drawn for it.
struct SeedWorld {
  World world;
  std::vector<Draw> draws;            ///< of `randomise:`, in the order in which they were made
  std::vector<std::string> left_out;  ///< things that found no place
};

/// Moves balls by the placement jitter, draws their radii within their tolerance, then draws what
/// `randomise:` leaves to chance. What a key draws depends on the seed and its name alone; only where things
/// would stand in each other or hide too much, the later one takes its next attempt.
SeedWorld seed_world(const Scenario& scenario, std::uint64_t seed);

}  // namespace stereobench::worlds
