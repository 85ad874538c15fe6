#include <fmt/format.h>

#include "harness/commands/commands.h"
#include "harness/commands/scenario_arguments.h"
#include "harness/commands/shard_run.h"
#include "harness/commands/talk.h"
#include "harness/io/atomic_file.h"
#include "harness/io/text_table.h"
#include "harness/study_commands/sweep_run.h"

namespace stereobench::harness {
namespace {

int run_sweep(const SweepArguments& arguments) {
  const ScenarioArguments& base = arguments.scenario;
  SweepPlan plan = plan_sweep(arguments);
  warn_of_missing_textures(plan.cells.front().experiment.scenario, *base.meshes);
  const std::filesystem::path out = output_folder(base.run, plan.sweep.name + "_sweep");
  if (base.run.dry_run) {
    for (const CellPlan& cell : plan.cells)
      fmt::print("{}: would run {}\n", name_of(plan.sweep.variations, cell.values), work_of(cell.experiment));
    if (arguments.adaptive > 0) fmt::print("up to {} further cells where curves bend\n", arguments.adaptive);
    fmt::print("{} cells; results: {}\n", plan.cells.size(), (out / "").string());
    return kPassed;
  }
  plan_drives(arguments, plan);
  const std::string what = "sweep " + plan.sweep.name;
  if (const auto end = do_shard(out, base.run, {units_of(plan.drives), what, plan.pixels})) return *end;
  prepare_output_folder(out);
  const SweepOutcome outcome = sweep_into(out, arguments, plan);
  fmt::print("{}: {} cells\n\n{}\n{}\n", outcome.sweep.name, plan.cells.size(), kIntervalNote,
             sweep_table(outcome.sweep));
  say_gates(outcome.gate_lines, outcome.broken > 0);
  fmt::print("results: {}\n", (out / "").string());
  return outcome.broken == 0 ? kPassed : kGateBroken;
}

}  // namespace

void add_sweep_command(CLI::App& program, Action& action) {
  CLI::App* command = program.add_subcommand("sweep", "run a scenario over a grid of values, e.g. of noise");
  auto arguments = std::make_shared<SweepArguments>();
  add_scenario_options(*command, arguments->scenario);
  add_shard_options(*command, arguments->scenario.run.shards);
  repeatable(command->add_option(
                 "--vary", arguments->variations,
                 "a line of the scenario and its values, e.g. --vary camera.noise_sd_levels=0,1,2,4,8; may "
                 "be repeated; lines that vary together: --vary KEY1:KEY2=A1:A2,B1:B2"))
      ->type_name("KEY=A,B,C")
      ->required();
  command
      ->add_option(
          "--paired-to", arguments->paired_to,
          "a value of the first --vary: each cell is compared with the one that has it, seed by seed")
      ->type_name("VALUE");
  command
      ->add_option("--adaptive", arguments->adaptive,
                   "up to so many further values, where a filter's ATE bends most against --vary")
      ->check(CLI::Range(0, 1000).description(""))
      ->type_name("N");
  command->footer(
      "Every cell sees the same worlds and odometry, so that cells differ in what is varied alone. Filters "
      "are\n"
      "compared seed by seed, p by Wilcoxon's signed ranks. Cells that differ in nothing that the detector "
      "sees\n"
      "share their pictures.\n"
      "Writes sweep.png (detection error and ATE against the first --vary), sweep.csv and sweep.json; of "
      "one\n"
      "number with three values or more also response.png: floor, slope and knee of each filter's error.\n\n"
      "Example: stereobench sweep assets/scenarios/ball_circle.yaml --vary camera.noise_sd_levels=0,1,2,4,8 "
      "--seeds 0..9");
  command->callback([arguments, command, &action] {
    arguments->scenario.run.words = words_of(*command);
    arguments->scenario.run.shards.words = whole_words_of(*command);
    action = [arguments] { return run_sweep(*arguments); };
  });
}

}  // namespace stereobench::harness
