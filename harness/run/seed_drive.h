/// One seed of one experiment, driven and filtered: the unit of work that is spread over processes.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/drive/recording.h"
#include "harness/drive/seen_drive.h"
#include "harness/experiment/types.h"
#include "harness/frames/kept_pair.h"
#include "harness/types.h"
#include "slam/filter_config.h"

namespace stereobench::harness {

/// A picture of one step, with the detections drawn on it.
struct Snapshot {
  std::size_t step = 0;
  std::string png;
};

/// What one seed gave: the drive, each filter's run over it, in the experiment's order of filters, and what
/// they are held against.
struct SeedDrive {
  std::uint64_t seed = 0;
  Recording recording;
  std::vector<FilterRun> runs;
  References references;
  std::vector<Snapshot> snapshots;
  std::string detections;       ///< its lines of detections.csv
  std::vector<KeptPair> pairs;  ///< the worst first
};

/// What is wanted of a seed beside its scores.
struct SeedParts {
  bool steps = false;         ///< its lines of steps.csv, and its errors at each step
  bool map = false;           ///< what the map shows
  std::size_t snapshots = 0;  ///< how many pictures, evenly spread over the path
  bool log = false;           ///< what was measured
  bool detections = false;    ///< its lines of detections.csv, of a sensor with pixels
  std::size_t pairs = 0;      ///< how many of its stereo pairs, the worst, as they were taken
};

/// A seed to drive, what is wanted of it, and what renders it.
struct DriveTask {
  const Experiment* experiment = nullptr;
  std::uint64_t seed = 0;
  SeedParts parts = {};
  renderer::Backend backend = renderer::Backend::kSoftware;
  std::string key = {};                     ///< SHA-256 of all that the drive is made from; needed to keep it
  std::string kind = {};                    ///< the same without its seeds: tasks of a kind cost the same
  std::optional<StreamSeeds> streams = {};  ///< where parts have seeds of their own; none: all have `seed`
  /// SHA-256 of all that the detector's answers are made from: drives that share it look once. Empty: each
  /// looks for itself.
  std::string sight = {};
  std::string pictures = {};  ///< the same of the pairs that it is shown; empty where `sight` is

  StreamSeeds seeds() const { return streams.value_or(StreamSeeds(seed)); }
};

/// The start pose that filters are told, with its noise.
/// @param start the true one
slam::Pose told_start(const slam::Pose& start, const worlds::StartNoise& noise, std::uint64_t seed);

/// Runs each filter over a log.
/// @param seed of the filters' own random streams
/// @param timing the seconds of each filter are added to "filter.NAME"
std::vector<FilterRun> replay_filters(const MeasurementLog& log, const std::vector<std::string>& filters,
                                      const slam::FilterConfig& config, std::uint64_t seed, Timing& timing);

/// Drives a seed: the world is rendered once and replayed for each filter and reference.
SeedDrive drive_seed(const DriveTask& task, const std::function<void(double)>& on_progress);

/// The same where the detector's answers are there already: nothing is rendered. @param seen of the task's
/// pictures and detector; its timing is left out
SeedDrive drive_seen(const DriveTask& task, const SeenDrive& seen);

/// What became of a task that was driven together with others.
struct SharedSeedDrive {
  SeedDrive drive;
  std::string fault;  ///< one line: its detector is at fault, and there is no drive; empty: there is one
};

/// Drives a seed for several tasks whose pictures are the same: they are rendered once.
/// @param tasks of one seed and one back end, at least one; see record_together
/// @return one a task
std::vector<SharedSeedDrive> drive_together(const std::vector<DriveTask>& tasks,
                                            const std::function<void(double)>& on_progress);

}  // namespace stereobench::harness
