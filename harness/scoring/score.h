/// What filters are worth on a log: one run, and all seeds of a filter together.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "harness/scoring/landmark_map.h"
#include "harness/scoring/statistics.h"
#include "harness/scoring/trajectory.h"
#include "harness/types.h"

namespace stereobench::harness {

/// One filter run against the truth. A failed run has NaN in every metric.
struct FilterScore {
  bool failed = false;
  TrajectoryScore trajectory;
  double ate_aligned_at_sightings_rms_m = 0.0;           ///< aligned and scored only where something was seen
  MapScore map;                                          ///< in the world frame, as estimated
  MapScore map_aligned;                                  ///< after its own best alignment
  MapScore map_path_aligned;                             ///< after the path's best alignment
  std::vector<std::optional<double>> normalised_errors;  ///< NEES / rank, one per step
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
  Summary anees;  ///< over the steps of `anees_by_step`; mean 1 is honest, above is overconfident
  std::vector<std::optional<double>> anees_by_step;
  long landmarks_found_once = 0;  ///< these four are sums over the seeds
  long landmarks_duplicated = 0;
  long landmarks_missed = 0;
  long landmarks_spurious = 0;
  long failures = 0;
};

/// Scores one run against its log's truth.
/// @throws std::invalid_argument when a run that did not fail has not one pose and covariance per step
FilterScore score(const FilterRun& run, const MeasurementLog& log);

/// Puts the seeds of one filter together; failed runs are counted and enter no mean.
FilterSummary summarise(std::span<const FilterScore> scores, int particles);

}  // namespace stereobench::harness
