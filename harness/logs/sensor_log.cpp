#include "harness/logs/sensor_log.h"

namespace stereobench::harness {

SensorLog sensor_log(const MeasurementLog& log) {
  SensorLog result{log.start, {}};
  for (const LogStep& step : log.steps) result.steps.push_back({step.odometry, step.measurements});
  return result;
}

}  // namespace stereobench::harness
