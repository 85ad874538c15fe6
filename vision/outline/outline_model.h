/// The outline that a ball of a given centre and size must have, and what it covers of each pixel.
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>
#include <opencv2/core/types.hpp>

#include "vision/outline/edge.h"
#include "vision/tuning/rim.h"
#include "vision/types.h"

namespace stereobench::vision {

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
  /// @param blur_px standard deviation of the Gaussian that the picture makes of a point; 0 in focus
  OutlineModel(const Intrinsics& camera, const Eigen::Vector2d& centre_px, double radius_px,
               double blur_px = 0.0);

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

  /// How much of a pixel the ball covers. An outline bends away from its tangent, so that a pixel gathers
  /// from less of the disc than of the tangent's side: as if the edge lay s^2 / 2r further inside, s^2 being
  /// the variance of where the pixel's light comes from along the edge, 1/12 px^2 of a box and that of the
  /// blur.
  Coverage coverage(const RimPoint& rim) const {
    const double inside_px = 0.5 * (kPixelVariance_px2 + blur_px_ * blur_px_) / radius_px_;
    if (blur_px_ <= 0.0) return edge_coverage({rim.distance_px + inside_px, rim.normal});
    return blurred_coverage(rim.distance_px + inside_px, blur_px_);
  }

  /// Relative size of the concentric, similar ellipse through a point: 1 on the outline, 0 at its centre.
  double level(const Eigen::Vector2d& pixel_px) const { return std::sqrt(level2(pixel_px)); }

  /// The same, squared.
  double level2(const Eigen::Vector2d& pixel_px) const {
    const Eigen::Vector2d offset = pixel_px - centre_px_;
    return offset.dot(form_ * offset);
  }

  /// The columns of a row whose pixel centres lie within the similar ellipse of relative size `level`.
  ColumnSpan columns_within(double level, int row) const;

  const Eigen::Vector2d& centre_px() const { return centre_px_; }
  double radius_px() const { return radius_px_; }
  double blur_px() const { return blur_px_; }
  double semi_major_px() const { return semi_major_px_; }
  double semi_minor_px() const { return radius_px_ * radius_px_ / semi_major_px_; }

  /// How much further than a sharp edge a blurred one reaches.
  double blur_reach_px() const { return kRim.blur_reach * blur_px_; }

  /// How far inside or outside of the outline a pixel shows one thing alone.
  double pure_px() const { return kRim.pure_px + blur_reach_px(); }

 private:
  Eigen::Vector2d centre_px_;
  double radius_px_;
  double blur_px_;
  double semi_major_px_;
  Eigen::Matrix2d form_;  // offset' form offset = 1 on the outline
};

/// Visits what an image shows of the ring between two similar ellipses, row by row: one span of columns, or
/// two to either side of the ring's middle.
/// @param innermost, outermost relative sizes of the ellipses; nothing is left out in the middle for 0
/// @param row_step visits every so manyth row
/// @param visit takes a ColumnSpan within the image, not empty, and a row
template <typename Visit>
void visit_ring(const OutlineModel& outline, double innermost, double outermost, const cv::Size& image,
                int row_step, const Visit& visit) {
  const double extent = outline.semi_major_px() * outermost;
  const double centre = outline.centre_px().y();
  const int first_row = std::max(0, static_cast<int>(std::ceil(centre - extent)));
  const int last_row = std::min(image.height - 1, static_cast<int>(std::floor(centre + extent)));
  for (int y = first_row; y <= last_row; y += row_step) {
    const auto visit_seen = [&](int first, int last) {
      const ColumnSpan seen{std::max(0, first), std::min(image.width - 1, last)};
      if (seen.first <= seen.last) visit(seen, y);
    };
    const ColumnSpan outer = outline.columns_within(outermost, y);
    const ColumnSpan inner = outline.columns_within(innermost, y);
    if (inner.last > inner.first) {
      visit_seen(outer.first, inner.first);
      visit_seen(inner.last, outer.last);
    } else {
      visit_seen(outer.first, outer.last);
    }
  }
}

}  // namespace stereobench::vision
