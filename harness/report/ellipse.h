/// The uncertainty of a place, as a line to draw.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace stereobench::harness {

/// The 95 % quantile of chi-square with two degrees of freedom: the squared Mahalanobis distance that 95 % of
/// a plane's Gaussian stays within, -2 ln 0.05.
inline constexpr double kChiSquare95 = 5.991464547107979;

/// Traces the ellipse that holds 95 % of a Gaussian in the plane.
/// @param centre metres
/// @param covariance m^2, symmetric; eigenvalues below zero count as zero
/// @return a closed line of 49 points; empty when the covariance or the centre is not finite
std::vector<Eigen::Vector2d> ellipse_95(const Eigen::Vector2d& centre, const Eigen::Matrix2d& covariance);

}  // namespace stereobench::harness
