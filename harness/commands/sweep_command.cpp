#include <fmt/format.h>

#include "harness/commands/commands.h"
#include "harness/commands/scenario_arguments.h"
#include "harness/commands/talk.h"
#include "harness/dataset/atomic_file.h"
#include "harness/regression/gates.h"
#include "harness/report/text_table.h"
#include "harness/run/seed_drive.h"
#include "harness/sweep/grid.h"
#include "harness/sweep/sweep_result.h"

namespace stereobench::harness {
namespace {

struct SweepArguments {
  ScenarioArguments scenario;
  std::vector<std::string> variations;
};

std::vector<DriveTask> tasks_of(const std::vector<worlds::Scenario>& scenarios, renderer::Backend backend) {
  std::vector<DriveTask> tasks;
  for (const worlds::Scenario& scenario : scenarios)
    for (const std::uint64_t seed : scenario.seeds) tasks.push_back({&scenario, seed, 0, backend});
  return tasks;
}

void write_sweep(const std::filesystem::path& out, const SweepResult& sweep,
                 std::span<const SeedDrive> drives) {
  for (const NamedPicture& picture : sweep_pictures(sweep))
    write_file_atomically(out / picture.file_name, picture.png);
  write_file_atomically(out / "sweep.csv", sweep_csv(sweep));
  write_file_atomically(out / "timing.json", timing_json(drives).dump(2) + "\n");
  write_file_atomically(out / "sweep.json", sweep_json(sweep).dump(2) + "\n");
}

/// Holds each cell against the gates of its scenario. @return a line for each broken gate, and how many there
/// are
std::pair<std::string, std::size_t> gates_of_cells(const SweepResult& sweep,
                                                   const std::vector<worlds::Scenario>& scenarios) {
  std::string lines;
  std::size_t broken = 0;
  std::size_t gates = 0;
  for (std::size_t i = 0; i < scenarios.size(); ++i) {
    const auto limits = gates_of(scenarios[i]);
    const auto off = broken_gates(run_json(sweep.cells[i].result), limits);
    if (!off.empty())
      lines += gate_report(off, limits.size(), name_of(sweep.variations, sweep.cells[i].values) + ": ");
    broken += off.size();
    gates += limits.size();
  }
  if (broken == 0) lines = gate_report({}, gates);
  return {lines, broken};
}

int run_sweep(const SweepArguments& arguments) {
  SweepResult sweep;
  for (const std::string& text : arguments.variations) sweep.variations.push_back(parse_variation(text));
  const std::vector<Cell> cells = grid(sweep.variations);
  std::vector<worlds::Scenario> scenarios;
  for (const Cell& cell : cells)
    scenarios.push_back(read_scenario(arguments.scenario, overrides_of(sweep.variations, cell)));
  for (const worlds::Scenario& scenario : scenarios)
    check_metrics(gates_of(scenario), result_without_values(scenario));
  sweep.name = scenarios.front().name;
  const std::filesystem::path out = output_folder(arguments.scenario.run, sweep.name + "_sweep");
  if (arguments.scenario.run.dry_run) {
    for (std::size_t i = 0; i < cells.size(); ++i)
      fmt::print("{}: would run {}\n", name_of(sweep.variations, cells[i]), work_of(scenarios[i]));
    fmt::print("{} cells; results: {}\n", cells.size(), (out / "").string());
    return kPassed;
  }
  prepare_output_folder(out);
  const renderer::Backend backend = arguments.scenario.backend;
  const auto drives =
      drive_seeds(tasks_of(scenarios, backend), arguments.scenario.run.jobs, "sweep " + sweep.name);
  std::span<const SeedDrive> rest = drives;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::size_t seeds = scenarios[i].seeds.size();
    sweep.cells.push_back(
        assemble_cell(sweep.name, rendered_by(scenarios[i], backend), cells[i], rest.first(seeds)));
    rest = rest.subspan(seeds);
  }
  write_sweep(out, sweep, drives);
  const auto [gate_lines, broken] = gates_of_cells(sweep, scenarios);
  fmt::print("{}: {} cells\n\n{}\n{}\n", sweep.name, cells.size(), kIntervalNote, sweep_table(sweep));
  say_gates(gate_lines, broken > 0);
  fmt::print("results: {}\n", (out / "").string());
  return broken == 0 ? kPassed : kGateBroken;
}

}  // namespace

void add_sweep_command(CLI::App& program, Action& action) {
  CLI::App* command = program.add_subcommand("sweep", "run a scenario over a grid of values, e.g. of noise");
  auto arguments = std::make_shared<SweepArguments>();
  add_scenario_options(*command, arguments->scenario);
  command
      ->add_option("--vary", arguments->variations,
                   "a line of the scenario and its values, e.g. --vary camera.noise_sd_levels=0,1,2,4,8; may "
                   "be repeated; lines that vary together: --vary KEY1:KEY2=A1:A2,B1:B2")
      ->type_name("KEY=A,B,C")
      ->allow_extra_args(false)
      ->required();
  command->footer(
      "Every cell sees the same worlds and odometry, so that cells differ in what is varied alone. Filters "
      "are\n"
      "compared seed by seed, p by Wilcoxon's signed ranks.\n"
      "Writes sweep.png (detection error and ATE against the first --vary), sweep.csv and sweep.json.\n\n"
      "Example: stereobench sweep assets/scenarios/ball_circle.yaml --vary camera.noise_sd_levels=0,1,2,4,8 "
      "--seeds 0..9");
  command->callback([arguments, &action] { action = [arguments] { return run_sweep(*arguments); }; });
}

}  // namespace stereobench::harness
