/// Whether the noise that filters are told is the noise that logs have.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "harness/logs/sensor_log.h"
#include "slam/diagnosis/noise_fit.h"
#include "slam/filter_config.h"

namespace stereobench::harness {

/// How many logs a check looks at, at most: more say little more.
inline constexpr std::size_t kCheckedLogs = 10;

/// How many times as large as told a standard deviation is: estimate and 99.9 % interval. NaN where logs
/// cannot tell.
struct NoiseFactor {
  double factor = std::numeric_limits<double>::quiet_NaN();
  double low = std::numeric_limits<double>::quiet_NaN();
  double high = std::numeric_limits<double>::quiet_NaN();
};

/// What logs say of the noise that filters are told.
struct NoiseCheck {
  std::array<NoiseFactor, slam::kNoiseFactors> factors;  ///< of forward speed, turn rate, range, bearing
  std::size_t logs = 0;                                  ///< that were looked at
  bool converged = false;                                ///< else no factor is known
  long refused = 0;                                      ///< sightings that were left out as outliers
};

/// Fits the noise to the sightings of some logs, without their truth (slam::fit_noise).
///
/// @param config as filters are told
/// @param jobs processes; the result does not depend on them
NoiseCheck check_noise(const std::vector<SensorLog>& logs, const slam::FilterConfig& config, int jobs);

/// What stands in run.json. Factors that are not known are null; without a check there are 0 logs.
nlohmann::ordered_json noise_json(const NoiseCheck& check);

/// A row for each standard deviation, and a warning line for each that is told far too small or too large:
/// its interval lies beyond a factor of 1.25. Empty where logs cannot tell any.
std::string noise_table(const NoiseCheck& check);

}  // namespace stereobench::harness
