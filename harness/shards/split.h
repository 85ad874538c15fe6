/// Work cut into shards of like cost.
#pragma once

#include <cstddef>
#include <vector>

#include "harness/shards/shard.h"

namespace stereobench::harness {

/// Deals units of work out to shards: the costliest first, each to the shard that has least so far (longest
/// processing time first; Graham 1969: the costliest shard has at most 4/3 - 1/(3 n) of the least that can
/// be). Of equal costs the earlier unit, and of equal shards the first, come first.
/// @param costs of the units, finite and >= 0, in any unit of measure
/// @param shards >= 1
/// @return the shard of each unit, from 0
std::vector<std::size_t> split_by_cost(const std::vector<double>& costs, std::size_t shards);

/// The units that a shard does: its own, and the first `overlap` ones of the next shard.
/// @param costs of all units
/// @return places of units, ascending
std::vector<std::size_t> units_of_shard(const std::vector<double>& costs, const Shard& shard,
                                        std::size_t overlap);

}  // namespace stereobench::harness
