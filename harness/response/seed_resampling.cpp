#include "harness/response/seed_resampling.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "harness/statistics/statistics.h"
#include "slam/math/elementary.h"
#include "slam/math/random.h"

namespace stereobench::harness {
namespace {

/// Draws are as scattered as the seeds about their own mean, which is closer to them than the true one.
double widening(double seeds) {
  return std::sqrt(seeds / (seeds - 1.0));
}

}  // namespace

std::vector<SeedCounts> drawn_seeds(std::size_t seeds) {
  constexpr std::size_t kDraws = 2000;
  slam::RandomStream random(0, slam::Stream::kResample, seeds);
  std::vector<SeedCounts> draws(kDraws, SeedCounts(seeds, 0.0));
  for (SeedCounts& counts : draws)
    for (std::size_t i = 0; i < seeds; ++i)
      counts[static_cast<std::size_t>((std::uint64_t{seeds} * std::uint64_t{random.bits()}) >> 32U)] += 1.0;
  return draws;
}

Interval percentile_interval(std::vector<double> drawn, std::size_t seeds, double level) {
  constexpr double kNoBound = std::numeric_limits<double>::quiet_NaN();
  std::erase_if(drawn, [](double value) { return std::isnan(value); });
  if (drawn.empty()) return {kNoBound, kNoBound};
  std::ranges::sort(drawn);
  const auto count = static_cast<double>(seeds);
  const double t = student_t_bound(level, static_cast<long>(seeds) - 1) * widening(count);
  const double below = 0.5 * slam::complementary_error(t / std::numbers::sqrt2);
  const auto outside = static_cast<std::size_t>(below * static_cast<double>(drawn.size()));
  return {drawn[outside], drawn[drawn.size() - 1 - outside]};
}

double drawn_error(const std::vector<double>& drawn, std::size_t seeds) {
  const Summary summary = summarise(drawn);
  const auto count = static_cast<double>(seeds);
  return summary.count > 1 ? summary.sd * widening(count) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace stereobench::harness
