/// How far the shards of a job are, as their folders say.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "harness/cluster/cluster_job.h"

namespace stereobench::harness {

enum class ShardState {
  kNotBegun,
  kStopped,  ///< begun, neither finished nor under way
  kRunning,  ///< a process writes to its results
  kFinished
};

std::string_view name_of(ShardState state);

/// One a shard, from job.first_shard() on.
/// @throws std::runtime_error, one line, where a folder holds something else
std::vector<ShardState> states_of(const ClusterJob& job);

/// Numbers in a row as Slurm writes them: "2,7-9".
std::string ranges_of(const std::vector<std::size_t>& numbers);

}  // namespace stereobench::harness
