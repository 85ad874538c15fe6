/// A log in which it is settled whose each sighting is.
#pragma once

#include <span>
#include <vector>

#include "slam/ekf/ekf_slam.h"
#include "slam/filter_config.h"
#include "slam/reference/batch.h"

namespace stereobench::slam {

/// A log as an iterated EKF took it.
struct DecidedLog {
  /// Sightings have identities. Those that were refused are left out, and all of a frame that showed that the
  /// pose had drifted.
  std::vector<BatchStep> steps;
  /// By step and sighting of the log as it was: whose it is, believed or not; kUnknown where it is nobody's.
  std::vector<std::vector<int>> landmarks;
  long refused = 0;  ///< sightings that were left out
};

/// Runs an iterated EKF over a log, and takes down what it decides.
///
/// @param start world_from_robot before the first control
DecidedLog decide(const FilterConfig& config, const Pose& start, std::span<const BatchStep> steps);

/// Runs it once more over what was not left out: nothing is refused.
///
/// @param visit (const EkfSlam&, std::size_t step) after each step with sightings; their order is that of
/// EkfSlam::expected()
template <class Visit>
void replay(FilterConfig config, const Pose& start, const DecidedLog& log, const Visit& visit) {
  config.gate_probability = 1.0;
  EkfSlam filter(config, start, Linearisation::kIterated);
  for (std::size_t k = 0; k < log.steps.size(); ++k) {
    for (const Control& control : log.steps[k].controls) filter.predict(control);
    if (log.steps[k].sightings.empty()) continue;
    filter.update(log.steps[k].sightings);
    visit(filter, k);
  }
}

}  // namespace stereobench::slam
