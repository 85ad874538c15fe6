#include "harness/run_command/run_scenario.h"

#include "harness/commands/kept_drives.h"

namespace stereobench::harness {

RunResult run_into(const std::filesystem::path& out, const ScenarioArguments& arguments,
                   const Experiment& experiment, const std::vector<DriveTask>& tasks,
                   const std::string& pixels) {
  KeptDrives kept(out);
  RunFolder folder(out, arguments, experiment, pixels);
  kept.complete(tasks, arguments.run.jobs, "run " + experiment.scenario.name,
                [&](std::size_t, const SeedResult& seed) { folder.add(seed); });
  RunResult result = folder.finish();
  kept.discard();
  return result;
}

RunResult run_here_into(const std::filesystem::path& out, const ScenarioArguments& arguments,
                        const Experiment& experiment, const std::vector<DriveTask>& tasks,
                        const std::string& pixels) {
  RunFolder folder(out, arguments, experiment, pixels);
  for (const DriveTask& task : tasks) folder.add(score_seed(drive_seed(task, [](double) {}), task.parts));
  return folder.finish();
}

}  // namespace stereobench::harness
