#include "harness/study_commands/study_runs.h"

#include <deque>
#include <utility>

#include "harness/commands/shard_run.h"

namespace stereobench::harness {
namespace {

/// The drives of some cells.
struct StudyPlan {
  std::deque<Experiment> experiments;  ///< tasks refer to them
  std::vector<DriveTask> tasks;
  std::vector<std::size_t> cell_of;  ///< one a task
};

StudyPlan plan_study(const ScenarioArguments& base, const std::vector<StudyCell>& cells,
                     const std::string& pixels) {
  StudyPlan plan;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    plan.experiments.push_back(read_experiment(base, cells[i].lines));
    const auto more = drive_tasks(base, cells[i].lines, plan.experiments.back(), pixels, {}, cells[i].seeds);
    plan.tasks.insert(plan.tasks.end(), more.begin(), more.end());
    plan.cell_of.insert(plan.cell_of.end(), more.size(), i);
  }
  return plan;
}

}  // namespace

std::optional<int> do_study_shard(const ScenarioArguments& base, const std::vector<StudyCell>& cells,
                                  const std::filesystem::path& out, const std::string& what) {
  if (!base.run.shards.is_used()) return {};
  const std::string pixels = pixels_of(read_experiment(base).scenario, base.backend);
  StudyPlan plan = plan_study(base, cells, pixels);
  look_once(plan.tasks);
  return do_shard(out, base.run, {units_of(plan.tasks), what, pixels});
}

StudyRuns::StudyRuns(const ScenarioArguments& base, const std::filesystem::path& out, std::string what)
    : base_(base), what_(std::move(what)), kept_(out) {
  pixels_ = pixels_of(read_experiment(base_).scenario, base_.backend);
}

std::vector<SeedMetrics> StudyRuns::metrics(const std::vector<StudyCell>& cells) {
  StudyPlan plan = plan_study(base_, cells, pixels_);
  if (!keeps_sights_) look_once(plan.tasks);
  std::vector<SeedMetricsTally> tallies(cells.size());
  kept_.complete(plan.tasks, base_.run.jobs, what_,
                 [&](std::size_t task, const SeedResult& seed) { tallies[plan.cell_of[task]].add(seed); });
  drives_ += plan.tasks.size();
  std::vector<SeedMetrics> metrics;
  for (const SeedMetricsTally& tally : tallies) metrics.push_back(tally.metrics());
  return metrics;
}

}  // namespace stereobench::harness
