/// The noise of a detector, from what it made of balls whose places are known.
#pragma once

#include <span>
#include <vector>

#include "harness/detector_noise/sample.h"
#include "harness/statistics/statistics.h"
#include "slam/filter_config.h"

namespace stereobench::harness {

/// What filters can be told of a detector's noise.
struct FittedNoise {
  /// By how much range and bearing are worse than stated: the noise of `kind: per_observation`.
  Eigen::Vector2d stated_sd_scale = Eigen::Vector2d::Ones();
  slam::NoiseLaw stereo;  ///< that of `kind: stereo`, which sightings state nothing to
};

/// The noise under which the samples are likeliest, each coordinate for itself. Samples whose stated
/// covariance is nothing, and those farther out than filters believe (chi-square of 0.9999 after a robust
/// first scale), are left out, as filters leave them out.
/// @return ones and zeros for no samples
FittedNoise fit_noise(std::span<const CalibrationSample> samples);

/// The covariances that filters take for a sample's, by the kinds of noise that they can be told.
enum class NoiseKind { kStated, kScaled, kStereo };
Eigen::Matrix2d covariance_of(const CalibrationSample& sample, const FittedNoise& noise, NoiseKind kind);

/// What samples of one kind, e.g. of one range of depths, say together.
struct CalibrationBin {
  double nearest_m = 0.0;
  double farthest_m = 0.0;
  bool whole = true;
  long samples = 0;
  long refused = 0;  ///< beyond the filters' gate under the scaled noise; they do not count for what follows
  Eigen::Vector2d bias = Eigen::Vector2d::Zero();  ///< range m, bearing rad; NaN for no samples
  Eigen::Vector2d sd = Eigen::Vector2d::Zero();    ///< about the bias, with n - 1; NaN for fewer than two
  Eigen::Vector2d over_bound =
      Eigen::Vector2d::Zero();  ///< the same in units of the bound, rms; NaN where there is none
  Eigen::Vector2d over_unknown_size = Eigen::Vector2d::Zero();  ///< of the bound for unknown size
  Eigen::Vector2d correlation = Eigen::Vector2d::Zero();  ///< of range and bearing: of the errors, as stated
  Eigen::Vector3d half_nis = Eigen::Vector3d::Zero();     ///< by NoiseKind; 1 when consistent
  Summary disparity_error_px;                             ///< of those that tell of pixels
  double radius_rms_px = 0.0;                             ///< error of the outlines' radii, over both cameras
};

/// @param noise fitted to other samples
/// @param count of bins between the two depths, evenly over their logarithm; parts of balls are one bin more
std::vector<CalibrationBin> bin_samples(std::span<const CalibrationSample> samples, const FittedNoise& noise,
                                        double nearest_m, double farthest_m, int count);

}  // namespace stereobench::harness
