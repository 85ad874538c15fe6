#include <optional>

#include <fmt/format.h>

#include "harness/commands/commands.h"
#include "harness/commands/kept_drives.h"
#include "harness/commands/scenario_arguments.h"
#include "harness/commands/talk.h"
#include "harness/io/atomic_file.h"
#include "harness/io/text_table.h"
#include "harness/regression/gates.h"
#include "harness/result_pages/run_page.h"
#include "harness/result_pages/sweep_page.h"
#include "harness/run/run_output.h"
#include "harness/sweep/grid.h"
#include "harness/sweep/sweep_result.h"

namespace stereobench::harness {
namespace {

struct SweepArguments {
  ScenarioArguments scenario;
  std::vector<std::string> variations;
};

void write_sweep(const std::filesystem::path& out, const SweepResult& sweep,
                 const nlohmann::ordered_json& timing, const Provenance& made_from) {
  for (const NamedPicture& picture : sweep_pictures(sweep))
    write_file_atomically(out / picture.file_name, picture.png);
  write_file_atomically(out / "sweep.csv", sweep_csv(sweep));
  write_file_atomically(out / "timing.json", timing.dump(2) + "\n");
  write_file_atomically(out / kResolvedScenario, made_from.scenario);
  write_file_atomically(out / "sweep.json", sweep_json(sweep).dump(2) + "\n");
}

/// A cell before it is run.
struct CellPlan {
  Cell values;
  std::vector<std::string> overrides;
  Experiment experiment;
  Provenance made_from;
  std::vector<DriveTask> tasks;  ///< they refer to the experiment
};

/// The gates of a cell: those of its experiment but for the noise, which cells do not check.
std::vector<Gate> gates_of_cell(const Experiment& experiment) {
  std::vector<Gate> gates = gates_of(experiment);
  std::erase_if(gates, [](const Gate& gate) { return gate.metric.starts_with("noise."); });
  return gates;
}

/// @throws std::runtime_error when a cell's scenario cannot be read, or its gates name no number of run.json
std::vector<CellPlan> plans_of(const SweepArguments& arguments, const std::vector<Variation>& variations) {
  std::vector<CellPlan> plans;
  for (const Cell& cell : grid(variations)) {
    const auto overrides = overrides_of(variations, cell);
    plans.push_back({cell, overrides, read_experiment(arguments.scenario, overrides)});
    const Experiment& experiment = plans.back().experiment;
    check_metrics(gates_of_cell(experiment), result_without_values(experiment));
  }
  return plans;
}

/// Holds each cell against the gates of its experiment. @return a line for each broken gate, and how many
/// there are
std::pair<std::string, std::size_t> gates_of_cells(const SweepResult& sweep,
                                                   const std::vector<CellPlan>& plans) {
  std::string lines;
  std::size_t broken = 0;
  std::size_t gates = 0;
  for (std::size_t i = 0; i < plans.size(); ++i) {
    const auto limits = gates_of_cell(plans[i].experiment);
    const auto off = broken_gates(run_json(sweep.cells[i].result), limits);
    if (!off.empty())
      lines += gate_report(off, limits.size(), name_of(sweep.variations, sweep.cells[i].values) + ": ");
    broken += off.size();
    gates += limits.size();
  }
  if (broken == 0) lines = gate_report({}, gates);
  return {lines, broken};
}

std::string pixels_of_any(const std::vector<CellPlan>& plans, renderer::Backend backend) {
  for (const CellPlan& plan : plans)
    if (const worlds::Scenario& scenario = plan.experiment.scenario;
        scenario.sensor == worlds::SensorKind::kStereo)
      return pixels_of(scenario, backend);
  return {};
}

/// Adds to each plan its tasks and what it is made from. @return all tasks, cell by cell
std::vector<DriveTask> add_tasks(std::vector<CellPlan>& plans, const ScenarioArguments& base,
                                 const std::string& pixels) {
  std::vector<DriveTask> all;
  for (CellPlan& plan : plans) {
    plan.made_from = provenance_of(base, plan.overrides, plan.experiment, pixels);
    plan.tasks = drive_tasks(base, plan.overrides, plan.experiment, pixels, {});
    all.insert(all.end(), plan.tasks.begin(), plan.tasks.end());
  }
  return all;
}

/// Puts the cells together, one after the other, as the results of their seeds come in the order of plans.
class CellsOfSweep {
 public:
  CellsOfSweep(const std::vector<CellPlan>& plans, renderer::Backend backend, SweepResult& sweep)
      : plans_(plans), backend_(backend), sweep_(sweep) {}

  void add(const SeedResult& seed) {
    const CellPlan& plan = plans_[sweep_.cells.size()];
    if (!tally_) tally_.emplace(sweep_.name, rendered_by(plan.experiment.scenario, backend_));
    tally_->add(seed);
    if (++seeds_ == plan.tasks.size()) end_cell(plan);
  }

  const Timing& timing() const { return timing_; }

 private:
  void end_cell(const CellPlan& plan) {
    sweep_.cells.push_back(tally_->cell(plan.values));
    sweep_.cells.back().result.made_from = plan.made_from;
    for (const auto& [stage, seconds] : tally_->timing()) timing_[stage] += seconds;
    tally_.reset();
    seeds_ = 0;
  }

  const std::vector<CellPlan>& plans_;
  renderer::Backend backend_;
  SweepResult& sweep_;
  std::optional<CellTally> tally_;  ///< of the cell that is not complete
  std::size_t seeds_ = 0;           ///< in it
  Timing timing_;
};

int run_sweep(const SweepArguments& arguments) {
  const ScenarioArguments& base = arguments.scenario;
  SweepResult sweep;
  for (const std::string& text : arguments.variations) sweep.variations.push_back(parse_variation(text));
  std::vector<CellPlan> plans = plans_of(arguments, sweep.variations);
  sweep.name = plans.front().experiment.scenario.name;
  warn_of_missing_textures(plans.front().experiment.scenario, *base.meshes);
  const std::filesystem::path out = output_folder(base.run, sweep.name + "_sweep");
  if (base.run.dry_run) {
    for (const CellPlan& plan : plans)
      fmt::print("{}: would run {}\n", name_of(sweep.variations, plan.values), work_of(plan.experiment));
    fmt::print("{} cells; results: {}\n", plans.size(), (out / "").string());
    return kPassed;
  }
  prepare_output_folder(out);
  KeptDrives kept(out);
  const std::string pixels = pixels_of_any(plans, base.backend);
  const std::vector<DriveTask> tasks = add_tasks(plans, base, pixels);
  CellsOfSweep cells(plans, base.backend, sweep);
  kept.complete(tasks, base.run.jobs, "sweep " + sweep.name,
                [&](std::size_t, const SeedResult& seed) { cells.add(seed); });
  for (std::size_t i = 0; i < plans.size(); ++i)
    warn_of_blur(plans[i].experiment.scenario.shutter, sweep.cells[i].result.blur.value_or(CoarseBlur{}));
  const auto [gate_lines, broken] = gates_of_cells(sweep, plans);
  write_file_atomically(out / kReport, page_html(sweep_page(sweep, base.run.words, gate_lines)));
  write_sweep(out, sweep, timing_json(cells.timing(), tasks.size()),
              provenance_of(base, {}, plans.front().experiment, pixels));
  kept.discard();
  fmt::print("{}: {} cells\n\n{}\n{}\n", sweep.name, plans.size(), kIntervalNote, sweep_table(sweep));
  say_gates(gate_lines, broken > 0);
  fmt::print("results: {}\n", (out / "").string());
  return broken == 0 ? kPassed : kGateBroken;
}

}  // namespace

void add_sweep_command(CLI::App& program, Action& action) {
  CLI::App* command = program.add_subcommand("sweep", "run a scenario over a grid of values, e.g. of noise");
  auto arguments = std::make_shared<SweepArguments>();
  add_scenario_options(*command, arguments->scenario);
  repeatable(command->add_option(
                 "--vary", arguments->variations,
                 "a line of the scenario and its values, e.g. --vary camera.noise_sd_levels=0,1,2,4,8; may "
                 "be repeated; lines that vary together: --vary KEY1:KEY2=A1:A2,B1:B2"))
      ->type_name("KEY=A,B,C")
      ->required();
  command->footer(
      "Every cell sees the same worlds and odometry, so that cells differ in what is varied alone. Filters "
      "are\n"
      "compared seed by seed, p by Wilcoxon's signed ranks.\n"
      "Writes sweep.png (detection error and ATE against the first --vary), sweep.csv and sweep.json.\n\n"
      "Example: stereobench sweep assets/scenarios/ball_circle.yaml --vary camera.noise_sd_levels=0,1,2,4,8 "
      "--seeds 0..9");
  command->callback([arguments, command, &action] {
    arguments->scenario.run.words = words_of(*command);
    action = [arguments] { return run_sweep(*arguments); };
  });
}

}  // namespace stereobench::harness
