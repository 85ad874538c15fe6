/// Finished data sets that are put from one folder into another.
#pragma once

#include <filesystem>
#include <vector>

#include "harness/io/file_list.h"

namespace stereobench::harness {

/// Where a data set is taken from.
struct DatasetSource {
  std::filesystem::path folder;
  FileHashes files;  ///< of its manifest
};

/// Makes sure that two data sets have the same files.
/// @throws ShardConflict that names two files
void require_same_files(const DatasetSource& one, const DatasetSource& other);

/// Puts all files of a data set into a folder, as links, or as copies where the file systems differ, after
/// their hashes were checked; the manifest comes last. What is there already stays.
/// @throws std::runtime_error, one line, where a file is not as it was rendered
void place_dataset(const DatasetSource& source, const std::filesystem::path& target);

/// Puts the data sets of shards of `render` into one folder, each in its place.
/// @throws ShardConflict where two shards have different files of one; std::runtime_error as place_dataset.
/// Nothing is put there before all manifests agree
void place_datasets(const std::vector<std::filesystem::path>& shards, const std::filesystem::path& out);

}  // namespace stereobench::harness
