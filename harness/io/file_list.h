/// Which files a finished data set has, and what is in them.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace stereobench::harness {

/// The marker of a finished data set, and its key that lists the files.
inline constexpr const char* kFinishedDataset = "dataset.json";

/// Its key that says what size balls are made to.
inline constexpr const char* kBallSize = "balls";
/// Where dataset.json says by how many rows vision was told that the rig may be off.
inline constexpr const char* kRowsWithin = "rows_within_px";
inline constexpr const char* kFiles = "files";

/// Size and SHA-256 of each file: {"left/000000.png": {"bytes": 90000, "sha256": "..."}, ...}.
/// @throws std::runtime_error when one cannot be read
nlohmann::ordered_json file_list(const std::filesystem::path& folder, const std::set<std::string>& names);

/// The listed files that are missing, or do not hold what they held.
/// @param list as of file_list
/// @throws BadLine when it is no such list, or has names that lead out of the folder
std::vector<std::string> changed_files(const std::filesystem::path& folder, const nlohmann::json& list);

/// Checks that log, calibrations and balls of a data set are as they were rendered; its pictures say
/// themselves when they are cut short. A folder without a list of files is let be.
/// @throws std::runtime_error that names the file and says what to do
void require_as_rendered(const std::filesystem::path& folder);

}  // namespace stereobench::harness
