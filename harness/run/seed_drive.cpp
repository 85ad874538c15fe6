#include "harness/run/seed_drive.h"

#include <algorithm>

#include "harness/experiment/filter_config.h"
#include "harness/process/stopwatch.h"
#include "harness/report/detection_picture.h"
#include "harness/scoring/references.h"
#include "harness/scoring/replay.h"

namespace stereobench::harness {
namespace {

/// Whether `step` is one of `count` that are spread evenly over a path of `steps`.
bool is_snapshot_step(std::size_t step, std::size_t count, std::size_t steps) {
  for (std::size_t i = 0; i < count; ++i)
    if (step == i * steps / count) return true;
  return false;
}

References replay_references(const Recording& recording, const Experiment& experiment, Timing& timing) {
  const worlds::Scenario& scenario = experiment.scenario;
  Stopwatch watch(timing);
  References references;
  references.bound = watch.time(
      "reference.bound", [&] { return replay_bound(recording.log, scenario.path, scenario.odometry_noise); });
  references.batch =
      watch.time("reference.batch", [&] { return replay_batch(recording.log, filter_config(experiment)); });
  return references;
}

}  // namespace

std::vector<FilterRun> replay_filters(const MeasurementLog& log, const std::vector<std::string>& filters,
                                      const slam::FilterConfig& config, std::uint64_t seed, Timing& timing) {
  Stopwatch watch(timing);
  std::vector<FilterRun> runs;
  for (const std::string& filter : filters)
    runs.push_back(watch.time("filter." + filter, [&] { return replay(log, filter, config, seed); }));
  return runs;
}

SeedDrive drive_seed(const DriveTask& task, const std::function<void(double)>& on_progress) {
  SeedDrive drive{.seed = task.seed};
  Listeners listeners;
  listeners.on_progress = on_progress;
  listeners.on_frame = [&](const FrameEvent& event) {
    if (is_snapshot_step(event.step, task.parts.snapshots, task.experiment->scenario.path.size()))
      drive.snapshots.push_back(
          {event.step, draw_detection_picture(for_display(event.pair, task.experiment->scenario.camera),
                                              event.observations)});
  };
  drive.recording = record(*task.experiment, task.seed, listeners, task.backend, task.detector);
  drive.runs = replay_filters(drive.recording.log, task.experiment->filters, filter_config(*task.experiment),
                              task.seed, drive.recording.timing);
  drive.references = replay_references(drive.recording, *task.experiment, drive.recording.timing);
  return drive;
}

}  // namespace stereobench::harness
