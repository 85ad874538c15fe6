#include "slam/resampling.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "slam/elementary.h"

namespace stereobench::slam {

bool normalise(std::vector<double>& log_weights) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const double w : log_weights) {
    if (w > largest) largest = w;
  }
  if (!std::isfinite(largest)) {
    std::fill(log_weights.begin(), log_weights.end(), -logarithm(static_cast<double>(log_weights.size())));
    return false;
  }
  double sum = 0.0;
  for (double& w : log_weights) {
    w = std::isnan(w) ? -std::numeric_limits<double>::infinity() : w - largest;
    sum += exponential(w);
  }
  const double log_sum = logarithm(sum);
  for (double& w : log_weights) w -= log_sum;
  return true;
}

std::vector<double> weights_of(const std::vector<double>& log_weights) {
  std::vector<double> weights(log_weights.size());
  std::ranges::transform(log_weights, weights.begin(), exponential);
  return weights;
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
