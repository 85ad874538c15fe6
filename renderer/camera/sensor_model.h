/// From light to levels: the whole camera, pixel by pixel.
#pragma once

#include <cstdint>

#include <opencv2/core.hpp>

#include "worlds/camera_sensor.h"

namespace stereobench::renderer {

/// What the camera stores of a perfect picture.
///
/// A pixel gathers e = L V exposure / 255 full_well electrons, L its light in levels and V the vignette. The
/// number counted is Poisson's for e below 16, drawn by inversion, and above it e + sqrt(e - 1/18) z +
/// (z^2 - 1) / 6 with a standard normal z, which has Poisson's first three moments. Read noise and gain make
/// levels of it. A camera without a full well has neither shot nor read noise.
/// @param light BGR, linear: CV_8UC3 in levels, or CV_16UC3 in steps of 1/257 level
/// @param seed, sequence key of the noise, sequence = 2 * frame + camera; shot noise and the rest draw from
/// streams of their own
/// @return CV_8UC3 of the same size, encoded
cv::Mat develop(const cv::Mat& light, const worlds::CameraSensor& sensor, std::uint64_t seed,
                std::uint64_t sequence);

/// The same before levels are encoded and rounded, with the same noise.
/// @return CV_16UC3, linear, in steps of 1/257 level: 65535 is level 255
cv::Mat develop_linear16(const cv::Mat& light, const worlds::CameraSensor& sensor, std::uint64_t seed,
                         std::uint64_t sequence);

/// Light in whole levels, rounded. @param light as develop() takes it
cv::Mat in_levels(const cv::Mat& light);

/// The light that stored levels stand for: the encoding undone, in whole levels.
/// @param levels CV_8UC3, as develop() stores them; what is stored linearly is returned as it is
cv::Mat decode(const cv::Mat& levels, const worlds::CameraSensor& sensor);

/// The noise of a pixel that a camera without vignette has at a level of linear light.
///
/// @param level of the perfect picture, in [0, 255]
/// @return standard deviation in levels, gain included, before encoding and rounding
double noise_sd_levels(const worlds::CameraSensor& sensor, double level);

}  // namespace stereobench::renderer
