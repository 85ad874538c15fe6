#include "harness/regression_commands/suite_run.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "harness/commands/shard_run.h"
#include "harness/io/atomic_file.h"
#include "harness/regression/gates.h"
#include "harness/regression/result_folder.h"
#include "harness/run_command/run_folder.h"
#include "harness/suite/findings_file.h"
#include "harness/suite/looks.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

/// A case under way: the seeds that it is looked at with, look after look.
struct CaseRun {
  const PlannedCase* planned = nullptr;
  Experiment experiment;  ///< with the seeds of the present look
  std::vector<std::uint64_t> seeds;
  std::vector<std::size_t> looks;
  std::vector<DriveTask> tasks;
  CaseReport report;
  bool is_done = false;
};

/// @param obstacle to a comparison with the baseline; empty where there is none
void plan_looks(const SuiteArguments& arguments, const std::string& obstacle, CaseRun& run) {
  run.seeds = run.planned->experiment.seeds;
  run.looks = {run.seeds.size()};
  if (!arguments.until_decided || !obstacle.empty()) return;
  run.seeds = run.planned->baseline->seeds.seeds;
  run.looks = look_sizes(std::min(run.seeds.size(), static_cast<std::size_t>(arguments.max_seeds)));
}

VerdictSettings settings_of(const CaseRun& run, const Suite& suite) {
  const double alpha = suite.alpha / static_cast<double>(suite.cases.size());
  return {.alpha = alpha_of_look(alpha, run.looks.size()),
          .margins = run.planned->what.margins,
          .only = run.planned->what.metrics};
}

std::optional<PairedBalls> balls_of(const fs::path& before, const StoredResult& now) {
  if (!fs::exists(before) || now.detections.empty()) return {};
  return pair_findings(read_findings(before), read_detected_balls(now.detections));
}

/// What the suite's case asks for, and the present look has not.
std::string what_is_missing(const CaseRun& run) {
  const std::vector<std::uint64_t>& asked = run.planned->asked_seeds;
  const auto is_missing = [&](std::uint64_t seed) {
    return std::ranges::count(run.experiment.seeds, seed) == 0;
  };
  const auto missing = std::ranges::count_if(asked, is_missing);
  if (missing == 0) return {};
  return fmt::format("{} of the {} seeds that the suite asks for were not run", missing, asked.size());
}

/// "found 23 of 25 balls that had to be found; 0 spurious, 1 taken for another colour; range rms 2.01 mm"
std::string measured(const nlohmann::ordered_json& vision) {
  if (!vision.contains("visible") || vision["visible"] == 0) return {};
  std::string text =
      fmt::format("found {} of {} balls that had to be found; {} spurious, {} taken for another colour",
                  vision["found"].dump(), vision["visible"].dump(), vision["spurious"].dump(),
                  vision["misidentified"].dump());
  if (vision["range_rms_m"].is_number())
    text += fmt::format("; range rms {:.3g} mm", 1000.0 * vision["range_rms_m"].get<double>());
  return text;
}

/// Writes the result of a case and holds it against gates and baseline.
void judge_case(const SuitePlan& plan, const fs::path& out, KeptDrives& kept, CaseRun& run) {
  const PlannedCase& planned = *run.planned;
  const fs::path folder = out / planned.what.name;
  prepare_output_folder(folder);
  RunFolder files(folder, planned.arguments, run.experiment, plan.pixels);
  kept.hand_on(run.tasks, [&](std::size_t, const SeedResult& seed) { files.add(seed); });
  const RunResult result = files.finish();
  run.report.inputs.detector = result.detector;
  run.report.partial = what_is_missing(run);
  run.report.broken_gates.clear();
  const nlohmann::ordered_json metrics = run_json(result);
  if (metrics.contains("vision")) run.report.measured = measured(metrics["vision"]);
  for (const BrokenGate& gate : broken_gates(metrics, planned.gates))
    run.report.broken_gates.push_back(gate.message);
  if (!run.report.not_compared.empty()) return;
  const StoredResult now = read_result(folder);
  run.report.settings = settings_of(run, plan.suite);
  try {
    run.report.judgement = judge(planned.baseline->seeds, now.seeds, run.report.settings,
                                 balls_of(findings_file(plan.baseline, planned.what.name), now));
  } catch (const std::runtime_error& error) {
    run.report.not_compared = error.what();
  }
}

void note_look(std::size_t seeds, CaseRun& run) {
  if (run.looks.size() < 2) return;
  const auto& metrics = run.report.judgement->comparison.metrics;
  run.report.looks.push_back({seeds, run.report.settings.alpha,
                              std::ranges::count(metrics, Verdict::kInconclusive, &MetricVerdict::verdict)});
}

void note_error(const std::string& message, const fs::path& out, CaseRun& run) {
  run.is_done = true;
  run.report = {.name = run.planned->what.name,
                .inputs = run.planned->inputs,
                .error = message,
                .gates = run.planned->gates.size()};
  for (const char* file : {"run.json", "report.html", "steps.csv", "detections.csv.gz", "invocation.json"})
    fs::remove(out / run.planned->what.name / file);  // of an earlier test: it is not the result of this one
}

/// Cases that differ only in how they are judged have the same tasks.
void add_once(const DriveTask& task, std::vector<DriveTask>& group) {
  if (std::ranges::count(group, task.key, &DriveTask::key) == 0) group.push_back(task);
}

/// What the look needs, for all cases together: those that see the same pictures share them.
std::vector<std::vector<DriveTask>> drives_of_look(const SuitePlan& plan, std::size_t look,
                                                   std::vector<CaseRun>& runs) {
  std::map<std::pair<std::string, std::uint64_t>, std::vector<DriveTask>> groups;
  for (CaseRun& run : runs) {
    if (run.is_done) continue;
    const auto seeds = static_cast<std::ptrdiff_t>(run.looks[look]);
    run.experiment.seeds.assign(run.seeds.begin(), run.seeds.begin() + seeds);
    run.tasks = drive_tasks(run.planned->arguments, {}, run.experiment, plan.pixels, kRunParts);
    const std::size_t driven = look == 0 ? 0 : run.looks[look - 1];
    for (std::size_t i = driven; i < run.tasks.size(); ++i)
      add_once(run.tasks[i], groups[{run.planned->pictures, run.tasks[i].seed}]);
  }
  std::vector<std::vector<DriveTask>> tasks;
  for (auto& [pictures_and_seed, group] : groups) tasks.push_back(std::move(group));
  return tasks;
}

void judge_look(const SuitePlan& plan, const fs::path& out, std::size_t look,
                const std::map<std::string, std::string>& faults, KeptDrives& kept, CaseRun& run) {
  const auto is_fault = [&](const DriveTask& task) { return faults.contains(task.key); };
  const auto fault = std::ranges::find_if(run.tasks, is_fault);
  if (fault != run.tasks.end()) return note_error(faults.at(fault->key), out, run);
  judge_case(plan, out, kept, run);
  const bool is_last = look + 1 == run.looks.size();
  if (run.report.judgement) note_look(run.looks[look], run);
  run.is_done = is_last || !run.report.judgement || is_decided(run.report.judgement->comparison);
}

/// The cases before their first look.
std::vector<CaseRun> runs_of(const SuitePlan& plan, const SuiteArguments& arguments) {
  std::vector<CaseRun> runs;
  for (const PlannedCase& planned : plan.cases) {
    CaseRun& run = runs.emplace_back(CaseRun{.planned = &planned, .experiment = planned.experiment});
    run.report = {.name = planned.what.name,
                  .inputs = planned.inputs,
                  .not_compared = obstacle_to_comparison(planned, plan),
                  .gates = planned.gates.size()};
    plan_looks(arguments, run.report.not_compared, run);
  }
  return runs;
}

std::string in_words(const SuitePlan& plan) {
  return "test " + plan.suite.name;
}

}  // namespace

std::optional<int> do_suite_shard(const SuitePlan& plan, const SuiteArguments& arguments,
                                  const fs::path& out) {
  if (!arguments.run.shards.is_used()) return {};
  std::vector<CaseRun> runs = runs_of(plan, arguments);
  return do_shard(out, arguments.run, {drives_of_look(plan, 0, runs), in_words(plan), plan.pixels, true});
}

std::vector<CaseReport> run_suite(const SuitePlan& plan, const SuiteArguments& arguments, const fs::path& out,
                                  KeptDrives& kept) {
  std::vector<CaseRun> runs = runs_of(plan, arguments);
  std::size_t looks = 1;
  for (const CaseRun& run : runs) looks = std::max(looks, run.looks.size());
  for (std::size_t look = 0; look < looks; ++look) {
    const auto faults =
        kept.complete_groups(drives_of_look(plan, look, runs), arguments.run.jobs, in_words(plan));
    for (CaseRun& run : runs)
      if (!run.is_done) judge_look(plan, out, look, faults, kept, run);
  }
  std::vector<CaseReport> reports;
  for (CaseRun& run : runs) reports.push_back(std::move(run.report));
  return reports;
}

}  // namespace stereobench::harness
