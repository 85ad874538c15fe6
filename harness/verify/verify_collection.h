/// Proof of a collection: of each of its data sets, and of what lies beside them.
#pragma once

#include "harness/verify/verify_dataset.h"

namespace stereobench::harness {

/// Whether a folder is a collection, as `stereobench dataset` and `merge` write it.
bool is_collection(const std::filesystem::path& folder);

/// Checks all data sets that collection.json lists, and all files against the collection's manifest. Names of
/// files are told from the collection's folder.
/// @param on_progress is told the share that is done, 0 to 1
/// @throws std::runtime_error, one line, where collection.json cannot be read
Verification verify_collection(const std::filesystem::path& folder,
                               const std::function<void(double)>& on_progress);

/// Checks a folder, whichever of the two it is.
/// @param format of a data set whose folder does not tell it; empty: the folder tells
/// @param on_progress is told the share that is done, 0 to 1
/// @throws std::runtime_error, one line, where there is no data set of a known format
Verification verify_folder(const std::filesystem::path& folder, const std::string& format,
                           const std::function<void(double)>& on_progress);

}  // namespace stereobench::harness
