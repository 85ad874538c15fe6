#include "vision/outline/outline_model.h"

#include <algorithm>
#include <cmath>

namespace stereobench::vision {

OutlineModel::OutlineModel(const Intrinsics& camera, const Eigen::Vector2d& centre_px, double radius_px,
                           double blur_px)
    : centre_px_(centre_px), radius_px_(radius_px), blur_px_(blur_px) {
  // a / b = sqrt((D^2 - R^2) / (Z^2 - R^2)) = sqrt(1 + |m|^2 / (1 + b^2)), m the centre in normalised
  // coordinates
  const Eigen::Vector2d off_axis_px = centre_px - Eigen::Vector2d(camera.cx_px, camera.cy_px);
  const Eigen::Vector2d m = off_axis_px / camera.focal_px;
  const double r = radius_px / camera.focal_px;  // b^2 = r^2 b / a: a fixed point, reached in few steps
  double stretch = 1.0;
  for (int i = 0; i < 4; ++i) stretch = std::sqrt(1.0 + m.squaredNorm() / (1.0 + r * r / stretch));
  semi_major_px_ = radius_px * std::sqrt(stretch);
  const double semi_minor_px = radius_px / std::sqrt(stretch);
  const double m_norm = m.norm();
  const Eigen::Vector2d major = m_norm > 0.0 ? Eigen::Vector2d(m / m_norm) : Eigen::Vector2d(1.0, 0.0);
  const double across = 1.0 / (semi_minor_px * semi_minor_px);
  const double along = 1.0 / (semi_major_px_ * semi_major_px_);
  form_ = across * Eigen::Matrix2d::Identity() + (along - across) * major * major.transpose();
}

ColumnSpan OutlineModel::columns_within(double level, int row) const {
  // form_xx dx^2 + 2 form_xy dx dy + form_yy dy^2 <= level^2, solved for dx
  const double dy = row - centre_px_.y();
  const double half_slope = form_(0, 1) * dy;
  const double discriminant = half_slope * half_slope - form_(0, 0) * (form_(1, 1) * dy * dy - level * level);
  if (level <= 0.0 || !(discriminant >= 0.0)) return {};
  const double middle = centre_px_.x() - half_slope / form_(0, 0);
  const double reach = std::sqrt(discriminant) / form_(0, 0);
  return {static_cast<int>(std::ceil(middle - reach)), static_cast<int>(std::floor(middle + reach))};
}

}  // namespace stereobench::vision
