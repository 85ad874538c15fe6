/// The files a run leaves behind.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "harness/run/run_result.h"
#include "harness/run/seed_drive.h"
#include "worlds/types.h"

namespace stereobench::harness {

/// The scenario that a result was made from, with what the command line changed, beside the result.
inline constexpr const char* kResolvedScenario = "resolved_scenario.yaml";

/// Writes map.png and error.png, frames/*.png, steps.csv, timing.json, the resolved scenario and, last of
/// all, run.json: where there is a run.json, the run is complete.
/// @param out an existing folder that can be written
/// @param walls drawn into the map
/// @throws std::runtime_error when a file cannot be written
void write_run(const std::filesystem::path& out, const RunResult& result, std::span<const SeedDrive> drives,
               const std::vector<worlds::Wall>& walls);

}  // namespace stereobench::harness
