#include "slam/models/noise_law.h"

#include <algorithm>
#include <utility>

#include "slam/models/motion.h"

namespace stereobench::slam {

Observation observe(const RangeBearing& seen, const FilterConfig& config) {
  Observation observation{{seen.range_m, wrap_angle(seen.bearing_rad)}, seen.covariance};
  if (config.noise_law) {
    const Eigen::Vector2d sd(config.noise_law->range_sd_m, config.noise_law->bearing_sd_rad);
    observation.noise = sd.cwiseAbs2().asDiagonal();
    observation.range_sd_per_m2 = config.noise_law->range_sd_per_m2 * seen.sd_scale[0];
  } else {
    observation.noise =
        config.stated_sd_scale.asDiagonal() * seen.covariance * config.stated_sd_scale.asDiagonal();
  }
  observation.noise = seen.sd_scale.asDiagonal() * observation.noise * seen.sd_scale.asDiagonal();
  observation.noise.diagonal() += Eigen::Vector2d(config.range_floor_m, config.bearing_floor_rad).cwiseAbs2();
  return observation;
}

namespace {

FilterConfig with_floor_below(FilterConfig config, double range_m, double bearing_rad) {
  config.range_floor_m = std::min(config.range_floor_m, range_m);
  config.bearing_floor_rad = std::min(config.bearing_floor_rad, bearing_rad);
  return config;
}

}  // namespace

FilterConfig without_floor(FilterConfig config) {
  return with_floor_below(std::move(config), 1e-5, 1e-7);
}

FilterConfig with_low_floor(FilterConfig config) {
  return with_floor_below(std::move(config), 5e-5, 2.5e-6);
}

}  // namespace stereobench::slam
