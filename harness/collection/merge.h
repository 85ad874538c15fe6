/// Shards of a collection joined into one folder.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "harness/collection/collection_folder.h"
#include "harness/shards/shard_conflict.h"

namespace stereobench::harness {

/// Joins shards, and finishes the collection. Files are linked, or copied where the file systems differ,
/// after their hashes were checked. What is in the output folder already stays; interrupted, it goes on where
/// it was. The result is, to the byte, what `dataset` writes in one piece.
/// @param out may be one of the shards
/// @throws ShardConflict that names two files; std::runtime_error, one line, for shards of different
///   collections, data sets that no shard has, and files that are not as they were rendered. Nothing is
///   written before this is known of all manifests
CollectionTotals merge_shards(const std::vector<std::filesystem::path>& shards,
                              const std::filesystem::path& out,
                              const std::function<void(double)>& on_progress);

}  // namespace stereobench::harness
