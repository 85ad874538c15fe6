/// One seed of one scenario, driven and filtered: the unit of work that is spread over processes.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "harness/drive/recording.h"
#include "harness/types.h"
#include "slam/filter_registry.h"
#include "worlds/types.h"

namespace stereobench::harness {

class AnswerStore;

/// A picture of one step, with the detections drawn on it.
struct Snapshot {
  std::size_t step = 0;
  std::string png;
};

/// What one seed gave: the drive, each filter's run over it, in the scenario's order of filters, and what
/// they are held against.
struct SeedDrive {
  std::uint64_t seed = 0;
  Recording recording;
  std::vector<FilterRun> runs;
  References references;
  std::vector<Snapshot> snapshots;
};

/// A seed to drive, what renders it, and how many pictures of it to keep.
struct DriveTask {
  const worlds::Scenario* scenario = nullptr;
  std::uint64_t seed = 0;
  std::size_t snapshots = 0;  ///< evenly spread over the path
  renderer::Backend backend = renderer::Backend::kOsmesa;
  Detector detector = {};  ///< who looks; empty: as the scenario says
  std::string key = {};    ///< SHA-256 of all that the drive is made from; needed to keep it
};

/// The settings that a scenario gives its filters.
slam::FilterConfig filter_config(const worlds::Scenario& scenario);

/// Runs each filter over a log.
/// @param seed of the filters' own random streams
/// @param timing the seconds of each filter are added to "filter.NAME"
std::vector<FilterRun> replay_filters(const MeasurementLog& log, const std::vector<std::string>& filters,
                                      const slam::FilterConfig& config, std::uint64_t seed, Timing& timing);

/// Drives a seed: the world is rendered once and replayed for each filter and reference.
SeedDrive drive_seed(const DriveTask& task, const std::function<void(double)>& on_progress);

/// Drives many seeds in `jobs` processes at a time, with a progress line for people.
/// @param what is shown on the progress line
/// @return in the order of the tasks, whatever the number of jobs
std::vector<SeedDrive> drive_seeds(const std::vector<DriveTask>& tasks, int jobs, const std::string& what);

/// Drives those of the tasks that a store does not hold yet. Each drive is in the store as soon as it has
/// ended, and not in memory: a program that is killed loses those alone that it was at.
/// @param tasks each with its key
void drive_into(AnswerStore& store, const std::vector<DriveTask>& tasks, int jobs, const std::string& what);

/// Of all pictures of some drives.
CoarseBlur blur_of(std::span<const SeedDrive> drives);

/// The drives of some tasks, all of which a store holds, in their order.
std::vector<SeedDrive> drives_in(const AnswerStore& store, std::span<const DriveTask> tasks);

}  // namespace stereobench::harness
