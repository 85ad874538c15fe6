/// A scenario run from its seeds to its result.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/commands/scenario_arguments.h"
#include "harness/run/seed_drive.h"
#include "harness/run_command/run_folder.h"

namespace stereobench::harness {

/// Runs tasks in processes and writes the files of their run. What a killed run left there is made use of.
/// @param out an existing folder that can be written
/// @param tasks of drive_tasks, with what RunFolder writes of each seed (kRunParts)
/// @param pixels as of pixels_of
/// @return what is in run.json
RunResult run_into(const std::filesystem::path& out, const ScenarioArguments& arguments,
                   const Experiment& experiment, const std::vector<DriveTask>& tasks,
                   const std::string& pixels);

/// The same in this process, which may have rendered before: one drive after the other, and none is kept.
RunResult run_here_into(const std::filesystem::path& out, const ScenarioArguments& arguments,
                        const Experiment& experiment, const std::vector<DriveTask>& tasks,
                        const std::string& pixels);

}  // namespace stereobench::harness
