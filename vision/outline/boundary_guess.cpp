#include "vision/outline/boundary_guess.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include <Eigen/LU>

#include "vision/colour/patch_boundary.h"
#include "vision/tuning/outline_fit.h"

namespace stereobench::vision {
namespace {

// Once around the patch: angles about its middle grow, as far as their octants and slopes tell.
double turn_order(const Eigen::Vector2d& from_middle) {
  const double size = std::abs(from_middle.x()) + std::abs(from_middle.y());
  if (!(size > 0.0)) return 0.0;
  const double along = from_middle.x() / size;  // falls from 1 to -1 while y is positive
  return from_middle.y() >= 0.0 ? 1.0 - along : 3.0 + along;
}

ScratchVector<Eigen::Vector2d> a_few_in_order(ScratchVector<Eigen::Vector2d> points) {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& point : points) middle += point / static_cast<double>(points.size());
  std::ranges::sort(points, {}, [&](const Eigen::Vector2d& point) {
    return std::tuple(turn_order(point - middle), point.x(), point.y());
  });
  if (points.size() <= kBoundary.points) return points;
  ScratchVector<Eigen::Vector2d> few;
  for (std::size_t i = 0; i < kBoundary.points; ++i)
    few.push_back(points[i * points.size() / kBoundary.points]);
  return few;
}

// Empty when the points are on a line.
std::optional<Circle> circle_through(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                                     const Eigen::Vector2d& c) {
  Eigen::Matrix2d sides;
  sides << (b - a).transpose(), (c - a).transpose();
  if (!(std::abs(sides.determinant()) > 1e-9 * sides.squaredNorm())) return std::nullopt;
  const Eigen::Vector2d from_a =
      sides.inverse() * Eigen::Vector2d(0.5 * (b - a).squaredNorm(), 0.5 * (c - a).squaredNorm());
  return Circle{a + from_a, from_a.norm()};
}

// How many points lie on the circle.
std::size_t support(const Circle& circle, const ScratchVector<Eigen::Vector2d>& points) {
  const double tolerance = kBoundary.on_circle_px + kBoundary.on_circle * circle.radius_px;
  return static_cast<std::size_t>(std::ranges::count_if(points, [&](const Eigen::Vector2d& point) {
    return std::abs((point - circle.centre_px).norm() - circle.radius_px) <= tolerance;
  }));
}

}  // namespace

std::optional<Circle> guess_from_boundary(const cv::Mat& image, const Blob& blob) {
  const ScratchVector<Eigen::Vector2d> points = a_few_in_order(patch_boundary(image, blob, palette_table()));
  const double largest =
      kBoundary.largest_radius * std::max(blob.max_x - blob.min_x + 1, blob.max_y - blob.min_y + 1);
  std::optional<Circle> best;
  std::size_t most = static_cast<std::size_t>(kBoundary.least_on * static_cast<double>(points.size()));
  for (const std::size_t step : kBoundary.steps) {
    for (std::size_t i = 0; i < points.size() && 2 * step < points.size(); ++i) {
      const auto circle = circle_through(points[i], points[(i + step) % points.size()],
                                         points[(i + 2 * step) % points.size()]);
      if (!circle || circle->radius_px > largest) continue;
      const std::size_t on = support(*circle, points);
      if (on <= most) continue;
      most = on;
      best = circle;
    }
  }
  return best;
}

}  // namespace stereobench::vision
