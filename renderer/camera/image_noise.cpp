#include "renderer/camera/image_noise.h"

#include <cmath>

namespace stereobench::renderer {
namespace {

std::vector<double> make_quantiles() {
  std::vector<double> quantiles(kQuantiles);
  double sum = 0.0;
  for (std::size_t i = 0; i < kQuantiles / 2; ++i) {
    quantiles[i] = slam::normal_quantile((static_cast<double>(i) + 0.5) / static_cast<double>(kQuantiles));
    sum += 2.0 * quantiles[i] * quantiles[i];
  }
  const double to_unit_variance = std::sqrt(static_cast<double>(kQuantiles) / sum);
  for (std::size_t i = 0; i < kQuantiles / 2; ++i) {
    quantiles[i] *= to_unit_variance;
    quantiles[kQuantiles - 1 - i] = -quantiles[i];
  }
  return quantiles;
}

}  // namespace

const std::vector<double>& standard_normal_quantiles() {
  static const std::vector<double> quantiles = make_quantiles();
  return quantiles;
}

}  // namespace stereobench::renderer
