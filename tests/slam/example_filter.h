// The smallest filter there is, as docs/guide/developing.md shows it: constant velocity, blind to landmarks.
#pragma once

#include <cmath>
#include <span>

#include "slam/filter.h"

namespace stereobench::slam {

// Drives straight on at the first control's speed: x += v cos(heading) dt, y += v sin(heading) dt.
class ExampleFilter {
 public:
  explicit ExampleFilter(const Pose& start) : pose_(start) {}

  void predict(const Control& control) {
    if (!moves_) speed_mps_ = control.v_mps;
    moves_ = true;
    pose_.x_m += speed_mps_ * std::cos(pose_.heading_rad) * control.duration_s;
    pose_.y_m += speed_mps_ * std::sin(pose_.heading_rad) * control.duration_s;
  }
  void update(std::span<const RangeBearing>) {}
  Estimate estimate() const { return {.pose = pose_}; }
  Estimate estimate_without_map() const { return estimate(); }
  UpdateReport last_update() const { return {}; }
  int particle_count() const { return 1; }
  Decisions last_decisions() const { return {}; }

 private:
  Pose pose_;
  double speed_mps_ = 0.0;
  bool moves_ = false;
};

static_assert(FilterType<ExampleFilter>);

}  // namespace stereobench::slam
