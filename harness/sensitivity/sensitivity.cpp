#include "harness/sensitivity/sensitivity.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>

namespace stereobench::harness {

void check(const StudySettings& settings) {
  constexpr std::size_t kFewest = 16, kMost = 1'000'000;
  if (settings.samples < kFewest || settings.samples > kMost)
    throw std::runtime_error(
        fmt::format("--samples: expected {} to {}, got {}", kFewest, kMost, settings.samples));
  if (!(settings.level >= 0.5 && settings.level <= 0.99))
    throw std::runtime_error(fmt::format("--interval: expected 0.5 to 0.99, got {}", settings.level));
}

Sensitivity study_sensitivity(const Factors& factors, const StudySettings& settings,
                              const MetricAt& metric_at) {
  check(settings);
  const std::vector<StudyPoint> points = pick_freeze_points(factors, settings.samples, settings.seed);
  const std::vector<double> results = metric_at(points);
  if (results.size() != points.size())
    throw std::invalid_argument(
        fmt::format("a study of {} points got {} values", points.size(), results.size()));
  return {.scenario = "",
          .metric = "",
          .factors = factors,
          .settings = settings,
          .indices = sobol_indices(results, factors.size(), {settings.level, settings.seed})};
}

std::vector<std::size_t> order_by_total(const SobolIndices& indices) {
  std::vector<std::size_t> order(indices.factors.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t factor) {
    const double total = indices.factors[factor].total.value;
    return std::isfinite(total) ? -total : HUGE_VAL;
  };
  std::ranges::stable_sort(order, {}, key);
  return order;
}

}  // namespace stereobench::harness
