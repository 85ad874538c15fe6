#include <cstdio>

#include <fmt/format.h>

#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/kept_drives.h"
#include "harness/commands/scenario_arguments.h"
#include "harness/commands/shard_run.h"
#include "harness/commands/talk.h"
#include "harness/io/atomic_file.h"
#include "harness/regression/gates.h"
#include "harness/run/result_table.h"
#include "harness/run_command/run_scenario.h"

namespace stereobench::harness {
namespace {

int run(const ScenarioArguments& arguments) {
  const Experiment experiment = read_experiment(arguments);
  const worlds::Scenario& scenario = experiment.scenario;
  const std::filesystem::path out = output_folder(arguments.run, scenario.name);
  const auto gates = gates_of(experiment);
  check_metrics(gates, result_without_values(experiment));
  warn_of_crossings(worlds::crossings(scenario.path, worlds::feet_of(scenario.world.walls)));
  warn_of_missing_textures(scenario, *arguments.meshes);
  if (arguments.run.dry_run) {
    fmt::print("{}: would run {}; {} gates; results: {}\n", scenario.name, work_of(experiment), gates.size(),
               (out / "").string());
    return kPassed;
  }
  const std::string pixels = pixels_of(scenario, arguments.backend);
  const auto tasks = drive_tasks(arguments, {}, experiment, pixels, kRunParts);
  const std::string what = "run " + scenario.name;
  if (const auto end = do_shard(out, arguments.run, {units_of(tasks), what, pixels})) return *end;
  prepare_output_folder(out);
  const RunResult result = run_into(out, arguments, experiment, tasks, pixels);
  fmt::print("{}: {} seed{}, {} steps\n\n", scenario.name, tasks.size(), tasks.size() == 1 ? "" : "s",
             scenario.path.size());
  say(result_table(result) + "\n");
  const auto broken = broken_gates(run_json(result), gates);
  say_gates(gate_report(broken, gates.size()), !broken.empty());
  fmt::print("results: {}\n", (out / "").string());
  return broken.empty() ? kPassed : kGateBroken;
}

}  // namespace

void add_run_command(CLI::App& program, Action& action) {
  CLI::App* command =
      program.add_subcommand("run", "render a scenario, observe it, run the filters, score them");
  auto arguments = std::make_shared<ScenarioArguments>();
  add_scenario_options(*command, *arguments);
  add_shard_options(*command, arguments->run.shards);
  command->footer(
      "Each seed is rendered once and replayed for each filter. Writes run.json (metrics), steps.csv (every\n"
      "step), detections.csv.gz (every ball and detection), map.png, error.png, frames/ (detections drawn on "
      "the\n"
      "pictures), report.html (all on one page), timing.json and, where a world is left to chance, "
      "draws.jsonl.\n"
      "Exits with 1 when a gate of the scenario is broken.\n\n"
      "Example: stereobench run assets/scenarios/ball_circle.yaml --seeds 0..9 --set "
      "camera.noise_sd_levels=4");
  command->callback([arguments, command, &action] {
    arguments->run.words = words_of(*command);
    arguments->run.shards.words = whole_words_of(*command);
    action = [arguments] { return run(*arguments); };
  });
}

}  // namespace stereobench::harness
