/// What a robot measured, without its truth.
#pragma once

#include <vector>

#include "harness/types.h"
#include "slam/reference/batch.h"

namespace stereobench::harness {

/// A log as the SLAM stage is given it.
struct SensorLog {
  slam::Pose start;  ///< where the filters begin
  std::vector<slam::BatchStep> steps;
};

SensorLog sensor_log(const MeasurementLog& log);

}  // namespace stereobench::harness
