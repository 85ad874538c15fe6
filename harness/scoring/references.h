/// What the filters' errors are compared with: the least that is possible, and what the whole log at once
/// gives.
#pragma once

#include "harness/scoring/score.h"
#include "harness/types.h"
#include "slam/filter_config.h"
#include "worlds/types.h"

namespace stereobench::harness {

/// Drives both posterior Cramer-Rao bounds over a generated log. Each sighting is taken at its word: with the
/// covariance that it states, and of the landmark that it is of; where the log does not say, of the one that
/// it names or, where it names a colour only, of the one of its colour nearest to where it was seen. Knowing
/// identities is more than such a filter has, so it remains a bound.
/// @param log which starts at the truth
/// @param path the truth behind the log: poses and exact controls
/// @param noise what the odometry really has
/// @param start_covariance (x, y, heading) of the start that filters are told. Where its heading is uncertain
/// the bound is that of estimators that take the told start for the likeliest, as all do here; an estimate
/// that is drawn towards the start has a smaller mean squared error
/// @throws std::invalid_argument when the path has not one step for each step of the log
BoundRun replay_bound(const MeasurementLog& log, const worlds::GroundTruth& path,
                      const slam::OdometryNoise& noise,
                      const Eigen::Matrix3d& start_covariance = Eigen::Matrix3d::Zero());

/// Fits path and map to the whole log (slam::estimate_batch).
/// @return a run named "batch" without covariances; `failed` when the search did not converge
/// @throws std::invalid_argument when a setting or the start is out of range
FilterRun replay_batch(const MeasurementLog& log, const slam::FilterConfig& config);

/// What a bound says of one log; NaN where there is nothing to say it of.
struct BoundScore {
  double pose_rms_m = 0.0;  ///< over the steps: root of the mean trace of the position's covariance
  double heading_rms_rad = 0.0;
  double landmark_rms_m = 0.0;  ///< over the landmarks that were seen, in the end: the same for both bounds
};

/// The bounds of one log.
struct BoundScores {
  BoundScore filtering;  ///< of estimates that know the log up to each pose, as filters do
  BoundScore smoothing;  ///< of estimates that know the whole log, as the batch does
};

BoundScores score(const BoundRun& run);

/// How many times the least possible an estimator's error is: the root of its mean squared position error
/// over seeds and steps, over that of the bound it belongs to. 1 is the best there is; runs that failed are
/// left out on both sides.
struct Efficiency {
  double errors_m2 = 0.0;
  double least_m2 = 0.0;

  /// Adds a seed. @param bound filtering for filters, smoothing for the batch
  void add(const FilterScore& score, const BoundScore& bound);
  double ratio() const;  ///< NaN when there is nothing to compare
};

}  // namespace stereobench::harness
