#include "vision/outline/edge.h"

#include "slam/math/elementary.h"

namespace stereobench::vision {
namespace {

constexpr double kPixelVariance_px2 = 1.0 / 12.0;  // of a unit square, in any direction
constexpr double kFarOutside = 6.0;                // standard deviations

double spread_px(double blur_px) {
  return std::sqrt(blur_px * blur_px + kPixelVariance_px2);
}

double normal_density(double x) {
  constexpr double kPerRootOf2Pi = 0.3989422804014327;
  return kPerRootOf2Pi * slam::exponential(-0.5 * x * x);
}

double normal_tail(double x) {
  constexpr double kRootOfHalf = 0.7071067811865476;
  return 0.5 * slam::complementary_error(kRootOfHalf * x);
}

}  // namespace

Coverage blurred_coverage(double distance_px, double blur_px) {
  const double spread = spread_px(blur_px);
  const double x = distance_px / spread;
  return {normal_tail(x), normal_density(x) / spread};
}

double edge_width_px(double blur_px) {
  constexpr double kTwoRootsOfPi = 3.5449077018110318;
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
