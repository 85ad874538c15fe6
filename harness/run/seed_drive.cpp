#include "harness/run/seed_drive.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "harness/experiment/filter_config.h"
#include "harness/process/stopwatch.h"
#include "harness/report/detection_picture.h"
#include "harness/scoring/references.h"
#include "harness/scoring/replay.h"
#include "harness/vision_scoring/detection_table.h"
#include "slam/math/random.h"
#include "slam/models/belief.h"

namespace stereobench::harness {
namespace {

/// Whether `step` is one of `count` that are spread evenly over a path of `steps`.
bool is_snapshot_step(std::size_t step, std::size_t count, std::size_t steps) {
  for (std::size_t i = 0; i < count; ++i)
    if (step == i * steps / count) return true;
  return false;
}

/// Looks for a task, and keeps what it asks for.
/// @param drive must live as long as the onlooker, and so must `worst`
Onlooker onlooker_of(const DriveTask& task, SeedDrive& drive, WorstPairs& worst,
                     const std::function<void(double)>& on_progress) {
  Onlooker onlooker{.experiment = task.experiment};
  onlooker.listeners.on_progress = on_progress;
  onlooker.listeners.on_frame = [&task, &drive, &worst](const FrameEvent& event) {
    const worlds::Scenario& scenario = task.experiment->scenario;
    if (task.parts.detections)
      drive.detections += detection_rows({task.seed, event.step, event.world, event.rig}, event.match);
    if (is_snapshot_step(event.step, task.parts.snapshots, scenario.path.size()))
      drive.snapshots.push_back(
          {event.step, draw_detection_picture(for_display(event.pair, scenario.camera), event.observations)});
    worst.offer({task.seed, event.step, badness_of(score_match(event.match)), {}, {}},
                [&](KeptPair& kept) { keep_pictures(kept, for_display(event.pair, scenario.camera)); });
  };
  return onlooker;
}

/// Replays what was recorded for each filter and reference.
void run_filters(const DriveTask& task, SeedDrive& drive) {
  const slam::FilterConfig config = filter_config(*task.experiment);
  const worlds::Scenario& scenario = task.experiment->scenario;
  MeasurementLog& log = drive.recording.log;
  Stopwatch watch(drive.recording.timing);
  drive.references.bound = watch.time("reference.bound", [&] {
    return replay_bound(log, scenario.path, scenario.odometry_noise, start_covariance(scenario.start_noise));
  });
  log.start = told_start(log.start, scenario.start_noise, task.seeds().odometry);
  drive.runs =
      replay_filters(log, task.experiment->filters, config, task.seeds().filter, drive.recording.timing);
  drive.references.batch = watch.time("reference.batch", [&] { return replay_batch(log, config); });
}

std::string message_of(const std::exception_ptr& fault) {
  try {
    std::rethrow_exception(fault);
  } catch (const std::exception& error) {
    return error.what();
  }
}

}  // namespace

slam::Pose told_start(const slam::Pose& start, const worlds::StartNoise& noise, std::uint64_t seed) {
  slam::RandomStream random(seed, slam::Stream::kStart);
  const double x = random.normal(), y = random.normal(), heading = random.normal();
  return slam::boxplus(start,
                       {noise.position_sd_m * x, noise.position_sd_m * y, noise.heading_sd_rad * heading});
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
  WorstPairs worst(task.parts.pairs);
  const Onlooker onlooker = onlooker_of(task, drive, worst, on_progress);
  OnlookerResult look = std::move(record_together({onlooker}, task.seeds(), task.backend).front());
  if (look.fault) std::rethrow_exception(look.fault);
  drive.recording = std::move(look.recording);
  drive.pairs = worst.pairs();
  run_filters(task, drive);
  return drive;
}

SeedDrive drive_seen(const DriveTask& task, const SeenDrive& seen) {
  SeedDrive drive{.seed = task.seed, .recording = recording_of(*task.experiment, task.seeds(), seen)};
  run_filters(task, drive);
  return drive;
}

std::vector<SharedSeedDrive> drive_together(const std::vector<DriveTask>& tasks,
                                            const std::function<void(double)>& on_progress) {
  std::vector<SharedSeedDrive> drives(tasks.size());
  std::vector<WorstPairs> worst;
  for (const DriveTask& task : tasks) worst.emplace_back(task.parts.pairs);
  std::vector<Onlooker> onlookers;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    drives[i].drive.seed = tasks[i].seed;
    onlookers.push_back(onlooker_of(tasks[i], drives[i].drive, worst[i], on_progress));
  }
  std::vector<OnlookerResult> looks =
      record_together(onlookers, tasks.front().seeds(), tasks.front().backend);
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    if (looks[i].fault) {
      drives[i].fault = message_of(looks[i].fault);
      continue;
    }
    drives[i].drive.recording = std::move(looks[i].recording);
    drives[i].drive.pairs = worst[i].pairs();
    run_filters(tasks[i], drives[i].drive);
  }
  return drives;
}

}  // namespace stereobench::harness
