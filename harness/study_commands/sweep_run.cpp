#include "harness/study_commands/sweep_run.h"

#include <algorithm>
#include <functional>
#include <optional>

#include <fmt/format.h>

#include "harness/commands/kept_drives.h"
#include "harness/experiment/key_kind.h"
#include "harness/io/atomic_file.h"
#include "harness/process/standard_streams.h"
#include "harness/regression/gates.h"
#include "harness/result_pages/run_page.h"
#include "harness/result_pages/sweep_page.h"
#include "harness/run/run_output.h"
#include "harness/sweep/adaptive.h"
#include "harness/sweep/grid.h"
#include "harness/sweep/sweep_response.h"

namespace stereobench::harness {
namespace {

void write_sweep(const std::filesystem::path& out, const SweepResult& sweep,
                 const nlohmann::ordered_json& timing, const Provenance& made_from) {
  for (const NamedPicture& picture : sweep_pictures(sweep))
    write_file_atomically(out / picture.file_name, picture.png);
  write_file_atomically(out / "sweep.csv", sweep_csv(sweep));
  write_file_atomically(out / "timing.json", timing.dump(2) + "\n");
  write_file_atomically(out / kResolvedScenario, made_from.scenario);
  write_file_atomically(out / "sweep.json", sweep_json(sweep).dump(2) + "\n");
}

/// The gates of a cell: those of its experiment but for the noise, which cells do not check.
std::vector<Gate> gates_of_cell(const Experiment& experiment) {
  std::vector<Gate> gates = gates_of(experiment);
  std::erase_if(gates, [](const Gate& gate) { return gate.metric.starts_with("noise."); });
  return gates;
}

/// @throws std::runtime_error when the cell's scenario cannot be read, or its gates name no number of
/// run.json
CellPlan plan_of(const SweepArguments& arguments, const std::vector<Variation>& variations,
                 const Cell& cell) {
  const auto overrides = overrides_of(variations, cell);
  CellPlan plan{cell, overrides, read_experiment(arguments.scenario, overrides)};
  check_metrics(gates_of_cell(plan.experiment), result_without_values(plan.experiment));
  return plan;
}

CellPlans plans_of(const SweepArguments& arguments, const std::vector<Variation>& variations) {
  CellPlans plans;
  for (const Cell& cell : grid(variations)) plans.push_back(plan_of(arguments, variations, cell));
  return plans;
}

/// Holds each cell against the gates of its experiment. @return a line for each broken gate, and how many
/// there are
std::pair<std::string, std::size_t> gates_of_cells(const SweepResult& sweep, const CellPlans& plans) {
  std::string lines;
  std::size_t broken = 0;
  std::size_t gates = 0;
  for (const CellPlan& plan : plans) {
    const auto cell = std::ranges::find(sweep.cells, plan.values, &SweepCell::values);
    const auto limits = gates_of_cell(plan.experiment);
    const auto off = broken_gates(run_json(cell->result), limits);
    if (!off.empty())
      lines += gate_report(off, limits.size(), name_of(sweep.variations, cell->values) + ": ");
    broken += off.size();
    gates += limits.size();
  }
  if (broken == 0) lines = gate_report({}, gates);
  return {lines, broken};
}

std::vector<CellPlan*> pointers_to(CellPlans& plans) {
  std::vector<CellPlan*> pointers;
  for (CellPlan& plan : plans) pointers.push_back(&plan);
  return pointers;
}

std::string pixels_of_any(const CellPlans& plans, renderer::Backend backend) {
  for (const CellPlan& plan : plans)
    if (const worlds::Scenario& scenario = plan.experiment.scenario;
        scenario.sensor == worlds::SensorKind::kStereo)
      return pixels_of(scenario, backend);
  return {};
}

/// Gives cells their tasks.
/// @param keeps_sights whether cells that come later are the same to the detector
/// @return the tasks of all cells, one cell after the other
std::vector<DriveTask> drives_of(const ScenarioArguments& base, const std::vector<CellPlan*>& plans,
                                 const std::string& pixels, bool keeps_sights) {
  std::vector<DriveTask> tasks;
  for (CellPlan* plan : plans) {
    plan->tasks = drive_tasks(base, plan->overrides, plan->experiment, pixels, {});
    tasks.insert(tasks.end(), plan->tasks.begin(), plan->tasks.end());
  }
  if (!keeps_sights) look_once(tasks);
  return tasks;
}

/// Runs cells, and puts each together as the results of its seeds come.
class CellRuns {
 public:
  CellRuns(const ScenarioArguments& base, const std::filesystem::path& out, std::string name)
      : base_(base), name_(std::move(name)), kept_(out) {}

  /// @param plans of the cells
  /// @param tasks of drives_of for these plans
  /// @param pixels as of pixels_of
  /// @return the cells in the order of the plans
  std::vector<SweepCell> run(const std::vector<CellPlan*>& plans, const std::vector<DriveTask>& tasks,
                             const std::string& pixels) {
    for (CellPlan* plan : plans)
      plan->made_from = provenance_of(base_, plan->overrides, plan->experiment, pixels);
    drives_ += tasks.size();
    std::vector<SweepCell> cells;
    std::optional<CellTally> tally;
    std::size_t seeds = 0;
    kept_.complete(tasks, base_.run.jobs, "sweep " + name_, [&](std::size_t, const SeedResult& seed) {
      const CellPlan& plan = *plans[cells.size()];
      if (!tally) tally.emplace(name_, rendered_by(plan.experiment.scenario, base_.backend));
      tally->add(seed);
      if (++seeds < plan.tasks.size()) return;
      cells.push_back(end_of(*tally, plan));
      tally.reset();
      seeds = 0;
    });
    return cells;
  }

  nlohmann::ordered_json timing() const { return timing_json(timing_, drives_); }
  /// The results are written.
  void discard() { kept_.discard(); }

 private:
  SweepCell end_of(const CellTally& tally, const CellPlan& plan) {
    SweepCell cell = tally.cell(plan.values);
    cell.result.made_from = plan.made_from;
    for (const auto& [stage, seconds] : tally.timing()) timing_[stage] += seconds;
    warn_of_blur(plan.experiment.scenario.shutter, cell.result.blur.value_or(CoarseBlur{}));
    return cell;
  }

  const ScenarioArguments& base_;
  std::string name_;
  KeptDrives kept_;
  Timing timing_;
  std::size_t drives_ = 0;
};

/// Adds values where curves bend, one after the other.
void refine(const SweepArguments& arguments, CellPlans& plans, CellRuns& runs, const std::string& pixels,
            bool keeps_sights, SweepResult& sweep) {
  Variation& variation = sweep.variations.front();
  for (int i = 0; i < arguments.adaptive; ++i) {
    const auto value = next_value(sweep, takes_whole_numbers(variation.name()));
    if (!value) {
      note(fmt::format("--adaptive: {} of {} values added; no further value can be added", i,
                       arguments.adaptive));
      return;
    }
    const double number = numbers_of({{variation.name()}, {*value}}).front();
    const std::vector<double> numbers = numbers_of(variation);
    const auto place = std::ranges::upper_bound(numbers, number) - numbers.begin();
    plans.push_back(plan_of(arguments, sweep.variations, {*value}));
    const auto tasks = drives_of(arguments.scenario, {&plans.back()}, pixels, keeps_sights);
    sweep.cells.insert(sweep.cells.begin() + place, runs.run({&plans.back()}, tasks, pixels).front());
    variation.values.insert(variation.values.begin() + place, *value);
  }
}

/// @throws std::runtime_error where the command line asks for what does not go together
void check_arguments(const SweepArguments& arguments, const SweepResult& sweep) {
  const Variation& first = sweep.variations.front();
  if (!arguments.paired_to.empty() && std::ranges::count(first.values, arguments.paired_to) == 0)
    throw std::runtime_error(fmt::format("--paired-to: expected one of the values of --vary {} (got '{}')",
                                         first.name(), arguments.paired_to));
  if (arguments.adaptive == 0) return;
  if (sweep.variations.size() > 1 || first.keys.size() > 1)
    throw std::runtime_error("--adaptive: expected one --vary, of one key");
  std::vector<double> numbers;
  try {
    numbers = numbers_of(first);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(std::string("--adaptive: ") + error.what());
  }
  if (numbers.size() < 3 || std::ranges::adjacent_find(numbers, std::greater_equal<>()) != numbers.end())
    throw std::runtime_error(
        fmt::format("--adaptive: expected three or more ascending numbers in --vary {}", first.name()));
}

}  // namespace

SweepPlan plan_sweep(const SweepArguments& arguments) {
  SweepPlan plan;
  SweepResult& sweep = plan.sweep;
  for (const std::string& text : arguments.variations) sweep.variations.push_back(parse_variation(text));
  check_arguments(arguments, sweep);
  if (!arguments.paired_to.empty()) sweep.paired_to = arguments.paired_to;
  plan.cells = plans_of(arguments, sweep.variations);
  sweep.name = plan.cells.front().experiment.scenario.name;
  return plan;
}

void plan_drives(const SweepArguments& arguments, SweepPlan& plan) {
  const ScenarioArguments& base = arguments.scenario;
  plan.pixels = pixels_of_any(plan.cells, base.backend);
  const CellPlans& cells = plan.cells;
  plan.keeps_sights =
      arguments.adaptive > 0 && cells.size() > 1 && share_sight(base, cells[0].overrides, cells[1].overrides);
  plan.drives = drives_of(base, pointers_to(plan.cells), plan.pixels, plan.keeps_sights);
}

SweepOutcome sweep_into(const std::filesystem::path& out, const SweepArguments& arguments, SweepPlan& plan) {
  const ScenarioArguments& base = arguments.scenario;
  SweepResult& sweep = plan.sweep;
  CellRuns runs(base, out, sweep.name);
  sweep.cells = runs.run(pointers_to(plan.cells), plan.drives, plan.pixels);
  refine(arguments, plan.cells, runs, plan.pixels, plan.keeps_sights, sweep);
  if (const auto response = response_of(sweep)) sweep.response = fit_response(*response);
  const auto [gate_lines, broken] = gates_of_cells(sweep, plan.cells);
  write_file_atomically(out / kReport, page_html(sweep_page(sweep, base.run.words, gate_lines)));
  write_sweep(out, sweep, runs.timing(), provenance_of(base, {}, plan.cells.front().experiment, plan.pixels));
  runs.discard();
  return {std::move(sweep), gate_lines, broken};
}

}  // namespace stereobench::harness
