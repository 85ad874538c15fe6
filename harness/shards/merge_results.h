/// The results of shards, joined into one store.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "harness/shards/shard_record.h"

namespace stereobench::harness {

/// Makes sure that folders are all shards of one work.
/// @return the record of the first
/// @throws std::runtime_error, one line, for folders that are of different commands or are no shards, and
/// that names the shards that are missing or unfinished; ShardConflict where the same command was planned
/// differently
ShardRecord check_shards(const std::vector<std::filesystem::path>& shards);

/// Adds the results of shards to the store of a folder. A result is the same wherever it was made, but for
/// the time that it took.
/// @throws ShardConflict that names two files with different results of a drive, or one whose bytes have
/// changed since they were written. The folder has no store then
void merge_results(const std::vector<std::filesystem::path>& shards, const std::filesystem::path& out,
                   const std::function<void(double)>& on_progress);

}  // namespace stereobench::harness
