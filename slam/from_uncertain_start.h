/// Any filter, from a start pose that is known badly.
#pragma once

#include <span>
#include <utility>

#include "slam/filter.h"
#include "slam/models/uncertain_start.h"

namespace stereobench::slam {

/// A filter that believes its start, and estimates that do not: they say how far off it may be.
class FromUncertainStart {
 public:
  FromUncertainStart(Filter filter, const UncertainStart& start)
      : filter_(std::move(filter)), start_(start) {}

  void predict(const Control& control) { slam::predict(filter_, control); }
  void update(std::span<const RangeBearing> sightings) { slam::update(filter_, sightings); }
  Estimate estimate() const { return told(slam::estimate(filter_)); }
  Estimate estimate_without_map() const { return told(slam::estimate_without_map(filter_)); }
  UpdateReport last_update() const { return slam::last_update(filter_); }
  int particle_count() const { return slam::particle_count(filter_); }
  Decisions last_decisions() const { return slam::last_decisions(filter_); }

 private:
  Estimate told(Estimate estimate) const {
    estimate.covariance = start_.of_pose(estimate.pose, estimate.covariance);
    for (LandmarkEstimate& landmark : estimate.landmarks)
      landmark.covariance = start_.of_place(landmark.position_m, landmark.covariance);
    return estimate;
  }

  Filter filter_;
  UncertainStart start_;
};

}  // namespace stereobench::slam
