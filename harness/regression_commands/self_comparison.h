/// A result held against itself: the same experiment, run again.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace stereobench::harness {

/// Runs a result's experiment again and compares all that it gave, byte by byte: steps.csv,
/// detections.csv.gz, and run.json but for `made_from` and `noise`.
/// @param result a folder that `run` wrote
/// @param jobs processes at a time
/// @return the files that differ
/// @throws std::runtime_error where the scenario is no longer what it was, and as a run
std::vector<std::string> differences_to_another_run(const std::filesystem::path& result, int jobs);

}  // namespace stereobench::harness
