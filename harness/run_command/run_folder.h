/// The folder of a run in the making.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/commands/scenario_arguments.h"
#include "harness/run/run_output.h"

namespace stereobench::harness {

/// What a run keeps of each of its seeds.
inline constexpr SeedParts kRunParts = {
    .steps = true, .map = true, .snapshots = 4, .log = true, .detections = true, .pairs = 12};

/// What run.json says beside the sums over the seeds: whether the noise is as told, and what it was made
/// from.
/// @param sums over the seeds
/// @param logs of the first seeds; see kCheckedLogs
RunResult completed(RunResult sums, const std::vector<SensorLog>& logs, const ScenarioArguments& arguments,
                    const Experiment& experiment, const std::string& pixels);

/// Takes the results of an experiment's seeds, and writes the files of its run.
class RunFolder {
 public:
  /// @param out an existing folder that can be written
  /// @param arguments that the experiment was read by; must live as long as the folder, and so below
  /// @param pixels as of pixels_of
  RunFolder(std::filesystem::path out, const ScenarioArguments& arguments, const Experiment& experiment,
            std::string pixels);

  /// Adds a seed; they come in the experiment's order. @throws std::runtime_error when its lines cannot be
  /// written
  void add(const SeedResult& seed);

  /// Writes all files, run.json last. @return what is in it
  /// @throws std::runtime_error when a file cannot be written
  RunResult finish();

 private:
  std::filesystem::path out_;
  const ScenarioArguments& arguments_;
  const Experiment& experiment_;
  std::string pixels_;
  std::vector<SensorLog> logs_;
  RunOutput output_;
};

}  // namespace stereobench::harness
