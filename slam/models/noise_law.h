/// Measurement noise as a function of where a landmark should be seen.
#pragma once

#include <Eigen/Core>

#include "slam/filter_config.h"
#include "slam/models/belief.h"

namespace stereobench::slam {

/// A sighting with the noise that is believed of it: the law's, or what the sighting states itself to scale,
/// above the floor.
Observation observe(const RangeBearing& seen, const FilterConfig& config);

/// The settings with hardly any floor under the measurement noise. The floor keeps weights of particles from
/// vanishing. What has no weights, or weighs a whole block at once, needs it only against sensors that claim
/// to be exact.
FilterConfig without_floor(FilterConfig config);

/// The settings with a floor of 0.05 mm and 2.5 urad at most, for particles that are drawn around the mode.
/// With less a hundred of them claim too little, with more a thousand claim too much (lab book).
FilterConfig with_low_floor(FilterConfig config);

/// @param range_m where the landmark should be seen
/// @return by how much the variance of a range there exceeds that of a range of 0
inline double range_variance_growth(const Observation& observation, double range_m) {
  const double sd_m = observation.range_sd_per_m2 * range_m * range_m;
  return sd_m * sd_m;
}

/// The covariance of (range, bearing) of a sighting.
///
/// @param expected where the landmark should be seen; the sighting itself where nothing is expected yet
inline Eigen::Matrix2d noise_at(const Observation& observation, const Eigen::Vector2d& expected) {
  const Eigen::Vector2d to_range(1.0, 0.0);  // whole columns: a number written alone stalls who reads two
  Eigen::Matrix2d noise;
  noise.col(0) = observation.noise.col(0) + range_variance_growth(observation, expected.x()) * to_range;
  noise.col(1) = observation.noise.col(1);
  return noise;
}

}  // namespace stereobench::slam
