#include "slam/fastslam/resampling.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "slam/math/elementary.h"

namespace stereobench::slam {

bool normalise(std::vector<double>& log_weights, std::vector<double>& weights) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const double w : log_weights) {
    if (w > largest) largest = w;
  }
  if (!std::isfinite(largest)) {
    make_equal(log_weights, weights);
    return false;
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    double& log_weight = log_weights[i];
    log_weight = std::isnan(log_weight) ? -std::numeric_limits<double>::infinity() : log_weight - largest;
    weights[i] = exponential(log_weight);
    sum += weights[i];
  }
  const double log_sum = logarithm(sum);
  for (double& w : log_weights) w -= log_sum;
  for (double& w : weights) w /= sum;
  return true;
}

void make_equal(std::vector<double>& log_weights, std::vector<double>& weights) {
  const auto count = static_cast<double>(log_weights.size());
  std::ranges::fill(log_weights, -logarithm(count));
  std::ranges::fill(weights, 1.0 / count);
}

double effective_particles(const std::vector<double>& weights) {
  double sum = 0.0;
  for (const double w : weights) sum += w * w;
  return std::clamp(1.0 / sum, 1.0, static_cast<double>(weights.size()));
}

std::vector<int> systematic_descendants(const std::vector<double>& weights, double uniform) {
  const std::size_t count = weights.size();
  std::vector<int> descendants(count, 0);
  std::size_t particle = 0;
  double reached = weights[0];
  for (std::size_t i = 0; i < count; ++i) {
    const double position = (static_cast<double>(i) + uniform) / static_cast<double>(count);
    while (reached <= position && particle + 1 < count) reached += weights[++particle];
    ++descendants[particle];
  }
  return descendants;
}

std::vector<int> ancestors_in_place(const std::vector<int>& descendants) {
  std::vector<int> ancestors(descendants.size(), -1);
  for (std::size_t i = 0; i < descendants.size(); ++i) {
    if (descendants[i] > 0) ancestors[i] = static_cast<int>(i);
  }
  std::size_t vacant = 0;
  for (std::size_t i = 0; i < descendants.size(); ++i) {
    for (int copy = 1; copy < descendants[i]; ++copy) {
      while (ancestors[vacant] >= 0) ++vacant;
      ancestors[vacant] = static_cast<int>(i);
    }
  }
  return ancestors;
}

}  // namespace stereobench::slam
