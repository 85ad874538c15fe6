/// How an edge shows in the pixels that it crosses.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Core>

namespace stereobench::vision {

/// Where a pixel lies relative to an outline.
struct RimPoint {
  double distance_px = 0.0;                          ///< to the outline, positive outside, to first order
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();  ///< unit, outwards
};

/// Variance of where the light of a pixel comes from, in any direction: that of a unit square.
inline constexpr double kPixelVariance_px2 = 1.0 / 12.0;

/// What an edge leaves of a pixel, and how fast that changes when the edge moves outwards.
struct Coverage {
  double fraction = 0.0;  ///< of the pixel's light that comes from inside the outline, in [0, 1]
  double per_px = 0.0;    ///< derivative by a shift of the edge along its normal, >= 0
};

/// Coverage of a unit square pixel by the inside of an edge: a box filter, exact for straight edges.
inline Coverage edge_coverage(const RimPoint& rim) {
  const double nx = std::abs(rim.normal.x());
  const double ny = std::abs(rim.normal.y());
  const double larger = std::max(nx, ny);
  const double smaller = std::min(nx, ny);
  const double t = std::abs(rim.distance_px);
  const double corner = 0.5 * (larger + smaller);  // where the edge leaves the square
  const double side = 0.5 * (larger - smaller);    // where it meets the square's nearer corner
  if (t >= corner) return {rim.distance_px > 0.0 ? 0.0 : 1.0, 0.0};
  double outer = 0.5 - t / larger;
  double per_px = 1.0 / larger;
  if (t > side) {
    outer = (corner - t) * (corner - t) / (2.0 * larger * smaller);
    per_px = (corner - t) / (larger * smaller);
  }
  return {rim.distance_px > 0.0 ? outer : 1.0 - outer, per_px};
}

/// The same with the edge blurred to a ramp of the given half width: finds outlines that are further away.
inline Coverage ramp_coverage(const RimPoint& rim, double half_width_px) {
  const double fraction = 0.5 - 0.5 * rim.distance_px / half_width_px;
  if (fraction <= 0.0) return {0.0, 0.0};
  if (fraction >= 1.0) return {1.0, 0.0};
  return {fraction, 0.5 / half_width_px};
}

/// The same in a picture that is out of focus, where the light of a point becomes a Gaussian. A square pixel
/// gathers it with the variance 1/12 in each direction, so that
///     fraction = Phi(-d / s),  s^2 = blur^2 + 1/12,
/// within 0.008 of the box's and the Gaussian's convolution for a blur of 0.3 px and more.
/// @param blur_px the Gaussian's standard deviation, > 0
Coverage blurred_coverage(double distance_px, double blur_px);

/// How many pixels an edge crosses: the inverse of the mean of its slope, weighted by itself, 2 sqrt(pi) s.
/// What is wrong by a little in all of them moves the edge by so much more than in focus, where it is 1.
/// @param blur_px >= 0
double edge_width_px(double blur_px);

/// How much further inside than the pixel itself the places lie whose light from inside the edge a blurred
/// pixel gathers: their mean less and plus their standard deviation, of a normal distribution that is cut
/// off at the edge. What varies beside the edge, be it as steeply as a ball's shade, is on average what it is
/// at these two.
/// @param blur_px > 0
/// @return px, those of places inside the edge
std::array<double, 2> covered_depths_px(double distance_px, double blur_px);

/// How much less of the edge's inside a blurred pixel gathers when the blur grows: the derivative of the
/// fraction by blur^2, phi(d / s) d / (2 s^3).
/// @param blur_px >= 0
double coverage_per_blur2(double distance_px, double blur_px);

}  // namespace stereobench::vision
