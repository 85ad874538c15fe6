#include "harness/run_command/run_folder.h"

#include <utility>

#include "harness/commands/kept_drives.h"
#include "harness/dataset/draws_file.h"
#include "harness/experiment/filter_config.h"
#include "harness/io/atomic_file.h"
#include "harness/regression/gates.h"
#include "harness/result_pages/run_page.h"

namespace stereobench::harness {
namespace {

ReportCommands report_commands(const ScenarioArguments& arguments) {
  std::vector<std::string> render = {"stereobench", "render", arguments.scenario.string()};
  for (const std::string& change : arguments.overrides) render.insert(render.end(), {"--set", change});
  return {arguments.run.words, render};
}

}  // namespace

RunResult completed(RunResult sums, const std::vector<SensorLog>& logs, const ScenarioArguments& arguments,
                    const Experiment& experiment, const std::string& pixels) {
  sums.noise = check_noise(logs, filter_config(experiment), arguments.run.jobs);
  sums.made_from = provenance_of(arguments, {}, experiment, pixels);
  return sums;
}

RunFolder::RunFolder(std::filesystem::path out, const ScenarioArguments& arguments,
                     const Experiment& experiment, std::string pixels)
    : out_(std::move(out)),
      arguments_(arguments),
      experiment_(experiment),
      pixels_(std::move(pixels)),
      output_(out_, RunTally(experiment.scenario.name, rendered_by(experiment.scenario, arguments.backend))) {
}

void RunFolder::add(const SeedResult& seed) {
  output_.add(seed);
  if (seed.log) logs_.push_back(*seed.log);
}

RunResult RunFolder::finish() {
  const worlds::Scenario& scenario = experiment_.scenario;
  const RunResult result = completed(output_.result(), logs_, arguments_, experiment_, pixels_);
  warn_of_blur(scenario.shutter, result.blur.value_or(CoarseBlur{}));
  const RunStory story = {report_commands(arguments_), gates_of(experiment_), scenario.world.walls,
                          scenario.rig};
  output_.write(result, scenario.world.walls, [&](const RunResult& run, const RunCurves& curves) {
    write_run_report(out_, run, curves, story);
  });
  const std::string draws = draws_jsonl(scenario, experiment_.seeds);
  if (!draws.empty()) write_file_atomically(out_ / "draws.jsonl", draws);
  return result;
}

}  // namespace stereobench::harness
