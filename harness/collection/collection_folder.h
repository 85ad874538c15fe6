/// The folder of a collection: which of its data sets are finished, and what lies at its top.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/collection/collection_record.h"
#include "harness/io/file_list.h"

namespace stereobench::harness {

/// The list of a collection's data sets.
inline constexpr const char* kIndexFile = "index.csv";

/// A data set that is finished.
struct FinishedEntry {
  FileHashes files;  ///< of its manifest
  std::size_t pairs = 0;
};

/// A data set of a collection in a folder.
/// @return nothing where it is not finished
/// @throws std::runtime_error, one line, where another one lies there
std::optional<FinishedEntry> finished_entry(const std::filesystem::path& folder,
                                            const CollectionEntry& entry);

/// Makes sure that a folder, if it is there, has no data set that a collection of this record has not.
/// @throws std::runtime_error, one line, where it has, or is a data set itself
void refuse_strangers(const std::filesystem::path& folder, const CollectionRecord& record);

/// Begins a collection in a folder, or takes it up: writes collection.json where it is not there, or says
/// something else, and removes the manifest, since the collection is not finished from now on.
/// @throws std::runtime_error, one line, when the folder holds a data set of its own, or one that the
///   collection has not
void begin_collection(const std::filesystem::path& folder, const CollectionRecord& record);

/// The data sets that are not finished.
std::vector<std::string> missing_entries(const std::filesystem::path& folder, const CollectionRecord& record);

/// What a collection holds.
struct CollectionTotals {
  std::size_t datasets = 0;
  std::size_t pairs = 0;
};

/// Writes the index, the data card, the Croissant file, and last of all the manifest of all files. All data
/// sets are finished.
CollectionTotals finish_collection(const std::filesystem::path& folder, const CollectionRecord& record);

}  // namespace stereobench::harness
