#include "vision/outline/edge.h"

#include <numbers>

#include "slam/math/elementary.h"

namespace stereobench::vision {
namespace {

// Standard deviations, beyond which a normal tail is not divided by: it comes to 1e-9 there.
constexpr double kFarOutside = 6.0;

double spread_px(double blur_px) {
  return std::sqrt(blur_px * blur_px + kPixelVariance_px2);
}

double normal_density(double x) {
  constexpr double kPerRootOf2Pi = std::numbers::inv_sqrtpi * (0.5 * std::numbers::sqrt2);
  return kPerRootOf2Pi * slam::exponential(-0.5 * x * x);
}

double normal_tail(double x) {
  constexpr double kRootOfHalf = 0.5 * std::numbers::sqrt2;
  return 0.5 * slam::complementary_error(kRootOfHalf * x);
}

}  // namespace

Coverage blurred_coverage(double distance_px, double blur_px) {
  const double spread = spread_px(blur_px);
  const double x = distance_px / spread;
  return {normal_tail(x), normal_density(x) / spread};
}

double edge_width_px(double blur_px) {
  constexpr double kTwoRootsOfPi = 2.0 * std::numbers::inv_sqrtpi * std::numbers::pi;
  return blur_px > 0.0 ? kTwoRootsOfPi * spread_px(blur_px) : 1.0;
}

std::array<double, 2> covered_depths_px(double distance_px, double blur_px) {
  const double spread = spread_px(blur_px);
  const double x = std::min(distance_px / spread, kFarOutside);
  const double hazard = normal_density(x) / normal_tail(x);
  const double variance = std::max(0.0, 1.0 + x * hazard - hazard * hazard);
  const double mean = distance_px + spread * (hazard - x);
  const double deviation = spread * std::sqrt(variance);
  return {mean - deviation, mean + deviation};
}

double coverage_per_blur2(double distance_px, double blur_px) {
  const double spread = spread_px(blur_px);
  return normal_density(distance_px / spread) * distance_px / (2.0 * spread * spread * spread);
}

}  // namespace stereobench::vision
