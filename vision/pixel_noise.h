/// The noise of pictures as they are read.
#pragma once

#include <algorithm>

#include "slam/math/elementary.h"

namespace stereobench::vision {

/// Variance of a pixel's channel, levels^2: the image's noise, and rounding to levels.
/// @param noise_sd_levels standard deviation before rounding, >= 0
inline double pixel_variance(double noise_sd_levels) {
  return noise_sd_levels * noise_sd_levels + 1.0 / 12.0;
}

/// How much lower a level is than the mean of its noisy pixels, which do not go below black: x + g(x) is the
/// mean of max(0, x + z), z normal, and g(x) = exp(-2.3 (x + g(x))) to 0.004 (to 0.0003 at black itself).
/// @param mean of the pixels, >= 0
/// @param noise_sd of a pixel, > 0
/// @return at most `mean`
inline double raised_by_black(double mean, double noise_sd) {
  constexpr double kFarAbove = 3.0;
  const double above = mean / noise_sd;
  if (above > kFarAbove) return 0.0;
  return noise_sd * std::min(above, slam::exponential(-2.3 * above));
}

}  // namespace stereobench::vision
