/// The vocabulary of the harness: logs that filters are replayed on, and what they score.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "slam/types.h"
#include "slam/update_report.h"

namespace stereobench::harness {

inline constexpr std::int64_t kSecond_ns = 1'000'000'000;

/// One instant at which the robot looked: the odometry since the instant before, and what it saw.
struct LogStep {
  std::int64_t stamp_ns = 0;
  std::vector<slam::Control> odometry;  ///< as measured, with its noise
  std::vector<slam::RangeBearing> measurements;
  std::optional<slam::Pose> truth;  ///< world_from_robot, where it is known
  /// Whose each measurement is, which no filter is told: index into MeasurementLog::landmarks, or kUnknown
  /// for one of nothing. Empty where it is not known.
  std::vector<int> true_landmarks;
};

/// A landmark's true place.
struct LandmarkTruth {
  int landmark_id = slam::kUnknown;
  int colour_class = slam::kUnknown;
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
};

/// Everything that the SLAM stage is given, and the truth it is scored against. Rendered runs and
/// recorded logs of real robots come to the filters as this one type.
struct MeasurementLog {
  slam::Pose start;  ///< where the filters begin
  /// Whether the truth says that this is the start. False: the filters begin at the origin of a frame of
  /// their own, and nothing of it can be compared with the truth as it stands.
  bool start_is_true = true;
  std::vector<LogStep> steps;  ///< in order of time
  std::vector<LandmarkTruth> landmarks;
};

/// How a filter's decisions about sightings and landmarks turned out (judge, judge_map).
struct AssociationScore {
  long correct = 0;     ///< sightings given to their landmark, new ones of what was new, clutter not believed
  long wrong = 0;       ///< sightings given to another landmark, and clutter given to any
  long missed = 0;      ///< sightings of a landmark in the map that were taken for new, refused or ignored
  long imagined = 0;    ///< clutter taken for a new landmark
  long duplicated = 0;  ///< landmarks of the final map, beyond the first, that are the same true one
  long spurious = 0;    ///< landmarks of the final map that are none
};

/// What one update said of the filter itself.
struct UpdateRecord {
  std::vector<slam::NormalisedInnovation> innovations;  ///< of sightings, by their index in the step
  double effective_particles = 1.0;
  int distinct_ancestors = 1;  ///< of its particles, how many have descendants among the run's last ones
};

/// One filter's estimates over a log, aligned with its steps.
struct FilterRun {
  std::string filter;
  int particles = 1;
  std::uint64_t seed = 0;
  std::vector<slam::Pose> poses;
  std::vector<Eigen::Matrix3d> covariances;
  std::vector<UpdateRecord> updates;            ///< one a step, also where there was nothing to see
  slam::Estimate last;                          ///< the final estimate, with its map
  std::optional<AssociationScore> association;  ///< where the log says whose the sightings are
  bool failed = false;                          ///< it threw, or a pose was not finite
  std::string failure;                          ///< why, and at which step; empty when it did not fail
};

/// The least covariances that estimates over a log can have (slam/reference/posterior_bound.h).
struct BoundRun {
  std::vector<Eigen::Matrix3d> poses;           ///< of (x, y, heading), one a step, given the log up to it
  std::vector<Eigen::Matrix3d> smoothed_poses;  ///< the same, given the whole log
  std::vector<Eigen::Matrix2d> landmarks;       ///< in the end, of those that were seen
};

/// What filters are held against, beside the truth.
struct References {
  std::optional<BoundRun> bound;  ///< where the true controls are known
  FilterRun batch;                ///< the whole log at once; its covariances are zero
};

}  // namespace stereobench::harness
