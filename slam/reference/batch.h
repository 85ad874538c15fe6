/// The whole drive at once: the path and the map that explain a log best.
#pragma once

#include <span>
#include <vector>

#include "slam/filter_config.h"
#include "slam/types.h"

namespace stereobench::slam {

/// One instant of a log: the controls that led to it, as measured, and what was seen there.
struct BatchStep {
  std::vector<Control> controls;
  std::vector<RangeBearing> sightings;
};

/// The most probable path and map.
struct BatchEstimate {
  std::vector<Pose> path;                   ///< one a step
  std::vector<LandmarkEstimate> landmarks;  ///< their covariances are not computed and stay zero
  bool converged = false;  ///< false when the search gave up; path and map are then the best it met
};

/// Finds the most probable path and map given a whole log, the later for the earlier too: what filters
/// approximate, and a little more than they can have, for they must answer before the rest is seen.
///
/// Levenberg-Marquardt on sparse normal equations (Ceres), from the path and map of an iterated FastSLAM 2.0
/// of few particles; from dead reckoning the search would end in the nearest of many valleys. Sightings
/// without an identity are those of the nearest landmark of their colour in that map. What lies far beyond
/// the gate counts ever less (Cauchy's loss with the gate as its scale), so that outliers neither pull nor
/// must be found out first; a gate at probability 1 makes it the plain sum of squares. Invalid input is
/// passed over, as the filters do. Equal arguments give equal bytes.
///
/// @param config what is believed: odometry noise, noise law, floors, gate and colour spacing; particles
/// are not read
/// @param start world_from_robot before the first control, known exactly
/// @throws std::invalid_argument for a setting out of range or a start that is not finite
BatchEstimate estimate_batch(const FilterConfig& config, const Pose& start, std::span<const BatchStep> steps);

}  // namespace stereobench::slam
