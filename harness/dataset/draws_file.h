/// The log of what seeds drew for their worlds.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "worlds/types.h"

namespace stereobench::harness {

/// A line of JSON for each value that `randomise:` has drawn: the seed, the key, the value, and what it was
/// drawn from, [least, most] or a list of names; and one for each thing that found no place. Nothing is kept
/// of a drive for it: worlds are drawn again.
/// @return empty for scenarios that leave nothing to chance
std::string draws_jsonl(const worlds::Scenario& scenario, std::span<const std::uint64_t> seeds);

}  // namespace stereobench::harness
