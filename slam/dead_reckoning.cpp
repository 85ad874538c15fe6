#include "slam/dead_reckoning.h"

#include "slam/models/measurement.h"
#include "slam/models/motion.h"

namespace stereobench::slam {

DeadReckoning::DeadReckoning(const FilterConfig& config, const Pose& start)
    : noise_(config.odometry_noise), belief_{start, Eigen::Matrix3d::Zero()} {}

void DeadReckoning::predict(const Control& control) {
  move(belief_, Linearised(), control, noise_, counters_);
}

void DeadReckoning::update(std::span<const RangeBearing> sightings) {
  for (const RangeBearing& sighting : sightings) counters_.rejected_inputs += is_valid(sighting) ? 0 : 1;
}

Estimate DeadReckoning::estimate() const {
  return {.pose = belief_.mean, .covariance = belief_.covariance, .counters = counters_};
}

}  // namespace stereobench::slam
