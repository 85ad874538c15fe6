/// submitted.json: the jobs that were handed to the scheduler.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace stereobench::harness {

inline constexpr const char* kSubmissionsFile = "submitted.json";

/// The numbers of the array jobs of a folder, the latest last; none where nothing was submitted.
/// @throws std::runtime_error "file: key: what was expected"
std::vector<std::string> read_submissions(const std::filesystem::path& folder);

void write_submissions(const std::filesystem::path& folder, const std::vector<std::string>& arrays);

}  // namespace stereobench::harness
