#include "harness/study_commands/study_runs.h"

#include <deque>
#include <utility>

namespace stereobench::harness {

StudyRuns::StudyRuns(const ScenarioArguments& base, const std::filesystem::path& out, std::string what)
    : base_(base), what_(std::move(what)), kept_(out) {
  pixels_ = pixels_of(read_experiment(base_).scenario, base_.backend);
}

std::vector<SeedMetrics> StudyRuns::metrics(const std::vector<StudyCell>& cells) {
  std::deque<Experiment> experiments;  // tasks refer to them
  std::vector<DriveTask> tasks;
  std::vector<std::size_t> cell_of;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    experiments.push_back(read_experiment(base_, cells[i].lines));
    const auto more = drive_tasks(base_, cells[i].lines, experiments.back(), pixels_, {}, cells[i].seeds);
    tasks.insert(tasks.end(), more.begin(), more.end());
    cell_of.insert(cell_of.end(), more.size(), i);
  }
  if (!keeps_sights_) look_once(tasks);
  std::vector<SeedMetricsTally> tallies(cells.size());
  kept_.complete(tasks, base_.run.jobs, what_,
                 [&](std::size_t task, const SeedResult& seed) { tallies[cell_of[task]].add(seed); });
  drives_ += tasks.size();
  std::vector<SeedMetrics> metrics;
  for (const SeedMetricsTally& tally : tallies) metrics.push_back(tally.metrics());
  return metrics;
}

}  // namespace stereobench::harness
