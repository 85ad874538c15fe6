/// Paths on a map with a slider of time.
#pragma once

#include <string>
#include <vector>

#include "harness/page/page.h"
#include "harness/run/seed_result.h"
#include "harness/trajectories/path_view.h"
#include "worlds/types.h"

namespace stereobench::harness {

/// The first seed of a run.
/// @param seed with its map and track
/// @param walls drawn as lines
/// @return an empty map where the seed has none
PageMap map_of_seed(const SeedResult& seed, const std::vector<worlds::Wall>& walls);

/// A true path and one estimate, as they are seen from a side.
/// @param time_s one a pose of both paths
/// @param name of the estimate
PageMap map_of_paths(const std::vector<double>& time_s, const PathView& paths, const std::string& name);

}  // namespace stereobench::harness
