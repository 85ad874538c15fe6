/// How far an estimated path is from the true one.
#pragma once

#include <span>
#include <vector>

#include "harness/types.h"

namespace stereobench::harness {

/// An estimated pose beside the true one of the same instant.
struct PosePair {
  slam::Pose estimate;
  slam::Pose truth;
};

/// Absolute and relative trajectory errors; NaN where there is nothing to score.
struct TrajectoryScore {
  double ate_rms_m = 0.0;  ///< absolute trajectory error, as estimated
  double ate_max_m = 0.0;
  double ate_aligned_rms_m = 0.0;  ///< after the best SE(2) alignment
  double ate_aligned_max_m = 0.0;
  double heading_rms_rad = 0.0;  ///< wrapped, as estimated
  double rpe_rms_m = 0.0;        ///< error of the motion over a number of steps, position
  double rpe_heading_rms_rad = 0.0;
  double final_drift = 0.0;        ///< final position error per metre driven
  slam::Pose truth_from_estimate;  ///< the alignment
  long scored_steps = 0;           ///< steps with truth
};

/// The estimates of all steps whose truth is known.
/// @param poses one per step of the log
/// @throws std::invalid_argument when their numbers differ
std::vector<PosePair> pair_with_truth(std::span<const slam::Pose> poses, const MeasurementLog& log);

/// The rotation and shift of the plane that brings the estimated positions nearest to the true ones in
/// least squares (Umeyama 1991 without scale, in closed form for the plane).
/// @return identity when there is no pair; a shift alone when all positions coincide
slam::Pose align(std::span<const PosePair> pairs);

/// Scores a path.
/// @param pairs in order of time
/// @param rpe_steps the number of scored steps that a relative error spans, >= 1
TrajectoryScore score_trajectory(std::span<const PosePair> pairs, int rpe_steps = 10);

}  // namespace stereobench::harness
