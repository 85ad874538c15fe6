/// What filters are worth on a log: one run, and all seeds of a filter together.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/scoring/consistency.h"
#include "harness/scoring/consistency_summary.h"
#include "harness/scoring/landmark_map.h"
#include "harness/scoring/trajectory.h"
#include "harness/statistics/statistics.h"
#include "harness/types.h"

namespace stereobench::harness {

/// One filter run against the truth. A failed run has NaN in every metric. Where the truth does not say where
/// the filters started (MeasurementLog::start_is_true), what is not aligned is NaN, and maps are counted
/// after alignment.
struct FilterScore {
  bool failed = false;
  /// Brings estimates into the truth's frame: identity where that is theirs, else the best alignment of the
  /// path or, without a true path, of the landmarks that have identities. None where nothing tells.
  std::optional<slam::Pose> truth_from_estimate;
  TrajectoryScore trajectory;
  double ate_aligned_at_sightings_rms_m = 0.0;  ///< aligned and scored only where something was seen
  MapScore map;                                 ///< in the world frame, as estimated
  MapScore map_aligned;                         ///< after its own best alignment
  MapScore map_path_aligned;                    ///< after the path's best alignment
  std::vector<std::optional<SquaredSum>> normalised_errors;  ///< NEES and rank, one per step
  ConsistencyScore consistency;
};

/// All seeds of one filter.
struct FilterSummary {
  int particles = 1;
  Summary ate_rms_m;
  Summary ate_max_m;
  Summary ate_aligned_rms_m;
  Summary ate_aligned_at_sightings_rms_m;
  Summary heading_rms_rad;
  Summary rpe_rms_m;
  Summary final_drift;
  Summary landmark_rms_m;
  Summary landmark_aligned_rms_m;
  Summary landmark_path_aligned_rms_m;
  double ate_aligned_median_m = 0.0;
  Summary anees;  ///< over the seeds, of each run's mean; 1 is consistent, above is overconfident
  std::vector<SquaredSum> nees_by_step;  ///< summed over the seeds
  StepVerdict nees;
  ConsistencySummary consistency;
  long landmarks_found_once = 0;  ///< these four are sums over the seeds
  long landmarks_duplicated = 0;
  long landmarks_missed = 0;
  long landmarks_spurious = 0;
  long failures = 0;
};

/// Scores one run against its log's truth.
/// @throws std::invalid_argument when a run that did not fail has not one pose and covariance per step
FilterScore score(const FilterRun& run, const MeasurementLog& log);

/// The distance of an estimated position from the true one, m, in the truth's frame.
/// @return NaN where there is no truth, or nothing tells how the frames lie to each other
double position_error_m(const FilterScore& score, const slam::Pose& estimate, const LogStep& step);

/// Puts the seeds of one filter together, one after the other; failed runs are counted and enter no mean. It
/// keeps some numbers a run and sums over the runs for each step, so that its size does not grow with the
/// product of seeds and steps.
class FilterTally {
 public:
  void add(const FilterScore& score);
  FilterSummary summary(int particles, Seeds seeds = Seeds::kWorlds) const;

 private:
  FilterSummary counts_;                      ///< what is a plain sum over the seeds
  std::vector<std::vector<double>> metrics_;  ///< of each metric one value a run that did not fail
  std::vector<SquaredSum> nees_by_step_;
  ConsistencyTally consistency_;
};

}  // namespace stereobench::harness
