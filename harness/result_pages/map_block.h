/// The first seed of a run as a map with a slider of time.
#pragma once

#include <vector>

#include "harness/page/page.h"
#include "harness/run/seed_result.h"
#include "worlds/types.h"

namespace stereobench::harness {

/// @param seed with its map and track
/// @param walls drawn as lines
/// @return an empty map where the seed has none
PageMap map_of_seed(const SeedResult& seed, const std::vector<worlds::Wall>& walls);

}  // namespace stereobench::harness
