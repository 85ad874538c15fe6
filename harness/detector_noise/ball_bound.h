/// How well anybody can measure the range and the bearing of a ball in a pair of noisy pictures.
#pragma once

#include <array>

#include <Eigen/Core>

#include "vision/stereo/sphere.h"
#include "vision/types.h"

namespace stereobench::harness {

/// Cramer-Rao bounds: covariances of (range m, bearing rad); zero where nothing can be told.
struct BallBounds {
  Eigen::Matrix2d of_size = Eigen::Matrix2d::Zero();  ///< for balls whose size is known by its tolerance
  /// Bound for unknown size: of outlines' centres alone, though their radii are taken for known.
  Eigen::Matrix2d unknown_size = Eigen::Matrix2d::Zero();
};

/// The bounds that what both pictures tell of the ball's outlines makes.
///
/// An outline's radius tells depth as well, f R / r, where R is known: with the same contrast all around, the
/// bound for a known size is lower by sqrt(1 + 8 R^2 / B^2), for a baseline B.
/// @param ball true centre in the left camera's frame and true radius, metres
/// @param radius_sd_m tolerance of the radius, 0 is exactly known
/// @param information of the outlines, left and right (outline_information)
BallBounds ball_bounds(const vision::StereoRig& rig, const vision::SizedBall& ball, double radius_sd_m,
                       const std::array<Eigen::Matrix3d, 2>& information);

}  // namespace stereobench::harness
