/// The outline that a ball of a given centre and size must have, and what it covers of each pixel.
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "vision/types.h"

namespace stereobench::vision {

/// Where a pixel lies relative to an outline.
struct RimPoint {
  double distance_px = 0.0;                          ///< to the outline, positive outside, to first order
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();  ///< unit, outwards
};

/// Pixel columns of one row, both inclusive; none when last < first.
struct ColumnSpan {
  int first = 0;
  int last = -1;
};

/// The outline of a ball as an ellipse with three parameters: centre and radius of the circle of equal area.
/// The eccentricity and the direction of the major axis follow from them, since only spheres are looked at.
class OutlineModel {
 public:
  /// @param centre_px of the ellipse
  /// @param radius_px > 0
  OutlineModel(const Intrinsics& camera, const Eigen::Vector2d& centre_px, double radius_px);

  /// @param pixel_px a pixel's centre, not the ellipse's centre itself
  RimPoint rim_point(const Eigen::Vector2d& pixel_px) const {
    const Eigen::Vector2d offset = pixel_px - centre_px_;
    const Eigen::Vector2d gradient = form_ * offset;
    const double level2 = offset.dot(gradient);
    const double slope = std::sqrt(gradient.squaredNorm());
    if (!(slope > 0.0)) return {-radius_px_, Eigen::Vector2d(1.0, 0.0)};
    const double per_slope = 1.0 / slope;
    return {(level2 - std::sqrt(level2)) * per_slope, gradient * per_slope};
  }

  /// The distances of four pixels of a row at once.
  /// @param right_px, down_px from the outline's centre
  Eigen::Array4d distances_px(const Eigen::Array4d& right_px, double down_px) const {
    const Eigen::Array4d gradient_x = form_(0, 0) * right_px + form_(0, 1) * down_px;
    const Eigen::Array4d gradient_y = form_(1, 0) * right_px + form_(1, 1) * down_px;
    const Eigen::Array4d level2 = right_px * gradient_x + down_px * gradient_y;
    const Eigen::Array4d slope = (gradient_x.square() + gradient_y.square()).sqrt();
    return (level2 - level2.sqrt()) / slope;
  }

  /// Relative size of the concentric, similar ellipse through a point: 1 on the outline, 0 at its centre.
  double level(const Eigen::Vector2d& pixel_px) const {
    const Eigen::Vector2d offset = pixel_px - centre_px_;
    return std::sqrt(offset.dot(form_ * offset));
  }

  /// The columns of a row whose pixel centres lie within the similar ellipse of relative size `level`.
  ColumnSpan columns_within(double level, int row) const;

  const Eigen::Vector2d& centre_px() const { return centre_px_; }
  double radius_px() const { return radius_px_; }
  double semi_major_px() const { return semi_major_px_; }
  double semi_minor_px() const { return radius_px_ * radius_px_ / semi_major_px_; }

 private:
  Eigen::Vector2d centre_px_;
  double radius_px_;
  double semi_major_px_;
  Eigen::Matrix2d form_;  // offset' form offset = 1 on the outline
};

/// What a straight edge leaves of a pixel, and how fast that changes when the edge moves outwards.
struct Coverage {
  double fraction = 0.0;  ///< of the pixel's square inside the outline, in [0, 1]
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

}  // namespace stereobench::vision
