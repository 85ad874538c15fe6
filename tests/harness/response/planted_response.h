/// Responses whose truth is known.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "harness/response/response.h"
#include "slam/math/elementary.h"
#include "slam/math/random.h"

namespace stereobench::harness {

/// A curve that obeys the law but for its noise.
struct PlantedCurve {
  std::string name = "smoother";
  double floor_m = 0.3;
  double slope = 1.0;
  double spread = 0.3;     ///< sd of the logarithm of a seed's error
  double in_common = 0.5;  ///< correlation of a seed's logarithms at two levels
  double upper_knee = std::numeric_limits<double>::infinity();
  double exponent = 1.0;  ///< error^2 = floor^2 + (slope level^exponent)^2
};

/// Errors whose rms over all seeds there could be is the law's, with noise that is log-normal.
inline ResponseCurve plant(const PlantedCurve& planted, const std::vector<double>& levels, std::size_t seeds,
                           slam::RandomStream& random) {
  ResponseCurve curve{planted.name, std::vector(levels.size(), std::vector<double>(seeds))};
  for (std::size_t seed = 0; seed < seeds; ++seed) {
    const double common = random.normal();
    for (std::size_t i = 0; i < levels.size(); ++i) {
      const double sensor =
          levels[i] > 0.0
              ? planted.slope * slam::power(levels[i], planted.exponent) /
                    std::sqrt(1.0 + levels[i] * levels[i] / (planted.upper_knee * planted.upper_knee))
              : 0.0;
      const double noise =
          std::sqrt(planted.in_common) * common + std::sqrt(1.0 - planted.in_common) * random.normal();
      const double rms = std::sqrt(planted.floor_m * planted.floor_m + sensor * sensor);
      curve.values[i][seed] =
          rms * slam::exponential(planted.spread * noise - planted.spread * planted.spread);
    }
  }
  return curve;
}

/// @param key of the noise
inline Response plant_response(const std::vector<PlantedCurve>& filters, const PlantedCurve& bound,
                               const std::vector<double>& levels, std::size_t seeds, std::uint64_t key = 0) {
  slam::RandomStream random(key, slam::Stream::kOracle, seeds);
  Response response{"detector_noise.centre_sd_px", levels, {}, {}};
  for (const PlantedCurve& filter : filters) response.filters.push_back(plant(filter, levels, seeds, random));
  response.bound = plant(bound, levels, seeds, random);
  return response;
}

}  // namespace stereobench::harness
