/// How well anybody can measure a ball's outline in a noisy picture.
#pragma once

#include <optional>

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "vision/stereo/sphere.h"
#include "vision/types.h"

namespace stereobench::harness {

/// What a camera makes of the light.
struct PictureQuality {
  double noise_sd_levels = 0.0;  ///< of a pixel's channel, > 0
  double blur_px = 0.0;          ///< standard deviation of the Gaussian that it makes of a point
};

/// The Fisher information that a picture holds of an outline's centre and radius, both colours beside it
/// being known: the sum over rim pixels of the products of the gradients over the noise's variance,
/// A^2 pi r / sigma^2 of each coordinate of the centre, for an outline of radius r with the contrast A all
/// around, and twice that of the radius.
/// @param light CV_8UC3, the picture in focus, before noise
/// @param outline wholly inside of it, at least five pixels in radius
/// @return of (column, row, radius), 1 / px^2; zero where nothing of it can be told
Eigen::Matrix3d outline_information(const cv::Mat& light, const vision::Intrinsics& camera,
                                    const vision::OutlineEllipse& outline, const PictureQuality& quality);

/// The Cramer-Rao bound on an outline's centre, its radius being known.
/// @return covariance of the centre, px^2; empty where nothing of it can be told
std::optional<Eigen::Matrix2d> outline_bound(const cv::Mat& light, const vision::Intrinsics& camera,
                                             const vision::OutlineEllipse& outline,
                                             const PictureQuality& quality);

}  // namespace stereobench::harness
