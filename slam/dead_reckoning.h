/// The filter that looks at nothing: odometry summed up.
#pragma once

#include <span>

#include "slam/association/decisions.h"
#include "slam/models/linearised.h"
#include "slam/update_report.h"

namespace stereobench::slam {

/// Integrates controls; the covariance is that of the odometry's noise to first order. Sightings are checked
/// and counted like everywhere, and otherwise ignored.
class DeadReckoning {
 public:
  DeadReckoning(const FilterConfig& config, const Pose& start);

  void predict(const Control& control);
  void update(std::span<const RangeBearing> sightings);
  Estimate estimate() const;
  Estimate estimate_without_map() const { return estimate(); }
  UpdateReport last_update() const { return {}; }
  int particle_count() const { return 1; }
  Decisions last_decisions() const { return {}; }

 private:
  OdometryNoise noise_;
  PoseBelief belief_;
  FilterCounters counters_;
};

}  // namespace stereobench::slam
