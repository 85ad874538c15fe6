#include "harness/run/seed_drive.h"

#include <algorithm>

#include "harness/process/stopwatch.h"
#include "harness/report/detection_picture.h"
#include "harness/scoring/references.h"
#include "harness/scoring/replay.h"
#include "worlds/oracle.h"

namespace stereobench::harness {
namespace {

/// Whether `step` is one of `count` that are spread evenly over a path of `steps`.
bool is_snapshot_step(std::size_t step, std::size_t count, std::size_t steps) {
  for (std::size_t i = 0; i < count; ++i)
    if (step == i * steps / count) return true;
  return false;
}

References replay_references(const Recording& recording, const worlds::Scenario& scenario, Timing& timing) {
  Stopwatch watch(timing);
  References references;
  references.bound = watch.time(
      "reference.bound", [&] { return replay_bound(recording.log, scenario.path, scenario.odometry_noise); });
  references.batch =
      watch.time("reference.batch", [&] { return replay_batch(recording.log, filter_config(scenario)); });
  return references;
}

}  // namespace

slam::FilterConfig filter_config(const worlds::Scenario& scenario) {
  slam::FilterConfig config;
  config.particles = scenario.particles;
  config.draw_every = scenario.draw_every;
  config.refit = scenario.refit;
  config.odometry_noise = scenario.believed_odometry_noise;
  config.noise_law = scenario.believed_measurement_noise;
  config.stated_sd_scale = scenario.stated_sd_scale;
  config.colour_spacing_m = scenario.colour_spacing_m;
  config.association = scenario.association;
  if (scenario.sensor == worlds::SensorKind::kOracle)
    config.sector = scenario.believed_sector.value_or(worlds::sector_of(scenario.oracle));
  return config;
}

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
    if (is_snapshot_step(event.step, task.parts.snapshots, task.scenario->path.size()))
      drive.snapshots.push_back(
          {event.step,
           draw_detection_picture(for_display(event.pair, task.scenario->camera), event.observations)});
  };
  drive.recording = record(*task.scenario, task.seed, listeners, task.backend, task.detector);
  drive.runs = replay_filters(drive.recording.log, task.scenario->filters, filter_config(*task.scenario),
                              task.seed, drive.recording.timing);
  drive.references = replay_references(drive.recording, *task.scenario, drive.recording.timing);
  return drive;
}

}  // namespace stereobench::harness
