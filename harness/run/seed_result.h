/// What is kept of a seed's drive once its filters are scored: where the filters ran, so that covariances do
/// not leave the process.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/logs/sensor_log.h"
#include "harness/report/map_picture.h"
#include "harness/run/seed_drive.h"
#include "harness/scoring/references.h"
#include "harness/scoring/score.h"

namespace stereobench::harness {

class AnswerStore;

/// One filter's run over one seed, scored.
struct ScoredRun {
  std::string filter;
  int particles = 1;
  FilterScore score;
  std::optional<AssociationScore> association;
  slam::FilterCounters counters;
  std::vector<double>
      errors_m;  ///< of position, one a step of the log; NaN where unknown. See SeedParts::steps
  std::vector<SquaredSum> innovations;  ///< the same of its innovations; nothing summed where it saw nothing
};

/// What a map shows of each step, beside the paths.
struct MapTrack {
  std::vector<std::optional<slam::Pose>> truth;      ///< none where it is not known, or cannot be compared
  std::vector<std::vector<Eigen::Vector2d>> seen_m;  ///< where the sightings are, from the true pose
  /// One a filter, then one a step: of its position, m^2, in the truth's frame.
  std::vector<std::vector<Eigen::Matrix2d>> covariances;
};

/// One seed, scored. Of its steps it has what run.json sums up over seeds, and what SeedParts asks for.
struct SeedResult {
  std::uint64_t seed = 0;
  std::string detector = "none";      ///< see Recording
  std::optional<VisionScore> vision;  ///< empty for a sensor without pixels
  std::optional<FaultCounts> faults;  ///< see Recording
  CoarseBlur blur;
  Timing timing;
  long steps = 0;                ///< of the log
  bool start_is_true = true;     ///< see MeasurementLog
  bool identities_known = true;  ///< by every sighting
  std::vector<ScoredRun> runs;   ///< in the scenario's order of filters
  FilterScore batch;
  std::optional<BoundScores> bound;
  std::vector<double> bound_m2;   ///< variance of the position by the filtering bound, one a step
  std::string csv;                ///< its lines of steps.csv
  std::string detections_gz;      ///< its lines of detections.csv, packed; empty where nobody asked for them
  std::vector<double> time_s;     ///< of each step
  std::optional<MapPicture> map;  ///< without title and walls
  std::optional<MapTrack> track;  ///< where there is a map
  std::vector<Snapshot> snapshots;
  std::vector<KeptPair> pairs;  ///< the worst first
  std::optional<SensorLog> log;
};

/// Told of a seed's result. @param index of its task
using OnSeed = std::function<void(std::size_t index, const SeedResult& result)>;

/// Scores a drive against its truth and its references.
SeedResult score_seed(const SeedDrive& drive, const SeedParts& parts);

/// Drives many seeds in `jobs` processes at a time, scores each where it was driven, and hands on the results
/// in the order of the tasks, each as soon as it and all before it are there. A progress line is for people.
/// @param what is shown on the progress line
void drive_seeds(const std::vector<DriveTask>& tasks, int jobs, const std::string& what,
                 const OnSeed& on_seed);

/// The same with a store: tasks whose results it holds are not driven again. A result is in the store as soon
/// as its seed has ended, and in memory while it is handed on: a program that is killed loses those seeds
/// alone that it was at.
/// Tasks with the same sight look once: what their detectors answered is kept in the store as well.
/// @param tasks each with its key
void drive_into(AnswerStore& store, const std::vector<DriveTask>& tasks, int jobs, const std::string& what,
                const OnSeed& on_seed);

/// Drives tasks that share pictures into a store, and goes on where one fails.
/// @param groups tasks with their keys; those of a group are driven together (drive_together)
/// @return why there is no result, by the key of the task: its detector is at fault, or its process died
std::map<std::string, std::string> drive_groups(AnswerStore& store,
                                                const std::vector<std::vector<DriveTask>>& groups, int jobs,
                                                const std::string& what);

/// The first line of steps.csv.
std::string steps_csv_header();

/// A seed's result as bytes (CBOR), for its way from a worker to its parent: exact to the last bit; numbers
/// that are not finite survive.
std::string to_bytes(const SeedResult& result);

/// What to_bytes made bytes of.
SeedResult seed_result_from_bytes(std::string_view bytes);

}  // namespace stereobench::harness
