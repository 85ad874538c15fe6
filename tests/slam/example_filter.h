// The smallest filter there is, as docs/guide/contributing.md shows it: constant velocity, blind to
// landmarks.
#pragma once

#include <optional>
#include <span>

#include "slam/filter.h"
#include "slam/filter_config.h"
#include "slam/models/linearised.h"
#include "slam/models/measurement.h"

namespace stereobench::slam {

// Drives straight on at the first control's speed, as uncertain as the odometry.
class ExampleFilter {
 public:
  ExampleFilter(const FilterConfig& config, const Pose& start)
      : noise_(config.odometry_noise), belief_{start, Eigen::Matrix3d::Zero()} {}

  void predict(Control control) {
    if (is_valid(control)) {
      if (!speed_mps_) speed_mps_ = control.v_mps;
      control = {*speed_mps_, 0.0, control.duration_s};
    }
    move(belief_, Linearised(), control, noise_, counters_);  // counts what is not valid
  }
  void update(std::span<const RangeBearing> sightings) {
    for (const RangeBearing& sighting : sightings) counters_.rejected_inputs += is_valid(sighting) ? 0 : 1;
  }
  Estimate estimate() const {
    return {.pose = belief_.mean, .covariance = belief_.covariance, .counters = counters_};
  }
  Estimate estimate_without_map() const { return estimate(); }
  UpdateReport last_update() const { return {}; }
  int particle_count() const { return 1; }
  Decisions last_decisions() const { return {}; }

 private:
  OdometryNoise noise_;
  PoseBelief belief_;
  std::optional<double> speed_mps_;
  FilterCounters counters_;
};

static_assert(FilterType<ExampleFilter>);

}  // namespace stereobench::slam
