/// How well anybody can measure a ball's outline in a noisy picture.
#pragma once

#include <optional>

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "vision/sphere.h"
#include "vision/types.h"

namespace stereobench::harness {

/// What a camera makes of the light.
struct PictureQuality {
  double noise_sd_levels = 0.0;  ///< of a pixel's channel, > 0
  double blur_px = 0.0;          ///< standard deviation of the Gaussian that it makes of a point
};

/// The Cramer-Rao bound on an outline's centre, its radius and both colours beside it being known: the
/// inverse of the sum over rim pixels of the gradients' squares over the noise's variance, sigma^2 / (A^2 pi
/// r) for an outline of radius r with the contrast A all around.
/// @param light CV_8UC3, the picture in focus, before noise
/// @param outline wholly inside of it, at least five pixels in radius
/// @return covariance of the centre, px^2; empty where nothing of it can be told
std::optional<Eigen::Matrix2d> outline_bound(const cv::Mat& light, const vision::Intrinsics& camera,
                                             const vision::OutlineEllipse& outline,
                                             const PictureQuality& quality);

}  // namespace stereobench::harness
