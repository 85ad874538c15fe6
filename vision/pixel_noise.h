/// The noise of pictures as they are read.
#pragma once

namespace stereobench::vision {

/// Variance of a pixel's channel, levels^2: the image's noise, and rounding to levels.
/// @param noise_sd_levels standard deviation before rounding, >= 0
inline double pixel_variance(double noise_sd_levels) {
  return noise_sd_levels * noise_sd_levels + 1.0 / 12.0;
}

}  // namespace stereobench::vision
