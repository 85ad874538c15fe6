// Faults that are planted in the samples of shards: archives that are taken apart and put together again.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/harness/verify/planted_set.h"

namespace stereobench::harness {

/// The archive of a copy of the bend: six samples, bend_0_000002 to bend_0_000007.
inline const std::string kShard = "bend_0-000000.tar";

/// Names and bytes, in the archive's order.
using Members = std::vector<std::pair<std::string, std::string>>;

/// Reads the archive by its headers alone, without code of the program.
Members members_of(const PlantedSet& set);
/// Puts members into an archive, in the place of the one that is there.
void write_members(const PlantedSet& set, const Members& members);

inline void change_members(const PlantedSet& set, const std::function<void(Members&)>& change) {
  Members members = members_of(set);
  change(members);
  write_members(set, members);
}

/// Changes what the .json of each sample says. @param change is told which of the six it is
void change_samples(const PlantedSet& set,
                    const std::function<void(nlohmann::ordered_json& sample, std::size_t i)>& change);

}  // namespace stereobench::harness
