// The smallest filter there is, as docs/guide/developing.md shows it: constant velocity, blind to landmarks.
#pragma once

#include <span>

#include "slam/filter.h"
#include "slam/models/measurement.h"
#include "slam/models/motion.h"

namespace stereobench::slam {

// Drives straight on at the first control's speed. Inputs that are not finite are counted, and have no other
// effect.
class ExampleFilter {
 public:
  explicit ExampleFilter(const Pose& start) : pose_(start) {}

  void predict(const Control& control) {
    if (!is_valid(control)) {
      ++counters_.rejected_inputs;
      return;
    }
    if (!moves_) speed_mps_ = control.v_mps;
    moves_ = true;
    pose_ = advance(pose_, {speed_mps_, 0.0, control.duration_s});
  }
  void update(std::span<const RangeBearing> sightings) {
    for (const RangeBearing& sighting : sightings) counters_.rejected_inputs += is_valid(sighting) ? 0 : 1;
  }
  Estimate estimate() const { return {.pose = pose_, .counters = counters_}; }
  Estimate estimate_without_map() const { return estimate(); }
  UpdateReport last_update() const { return {}; }
  int particle_count() const { return 1; }
  Decisions last_decisions() const { return {}; }

 private:
  Pose pose_;
  double speed_mps_ = 0.0;
  bool moves_ = false;
  FilterCounters counters_;
};

static_assert(FilterType<ExampleFilter>);

}  // namespace stereobench::slam
