#include "harness/sweep/adaptive.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/io/number_table.h"

namespace stereobench::harness {
namespace {

/// How far a filter's ATE at a level is from the line through both neighbours, over the seeds.
Summary bend_at(const SweepResult& sweep, const std::vector<double>& x, std::size_t middle,
                std::size_t filter) {
  const double t = (x[middle] - x[middle - 1]) / (x[middle + 1] - x[middle - 1]);
  const std::vector<double>& left = sweep.cells[middle - 1].ate_m[filter];
  const std::vector<double>& right = sweep.cells[middle + 1].ate_m[filter];
  std::vector<double> bends = sweep.cells[middle].ate_m[filter];
  for (std::size_t seed = 0; seed < bends.size(); ++seed)
    bends[seed] -= (1.0 - t) * left[seed] + t * right[seed];
  return summarise(bends);
}

/// From the least mean ATE of a filter to the largest.
double height_of(const SweepResult& sweep, std::size_t filter) {
  std::vector<double> means;
  for (const SweepCell& cell : sweep.cells) means.push_back(summarise(cell.ate_m[filter]).mean);
  const auto [low, high] = std::ranges::minmax(means);
  return high - low;
}

/// Halfway; in ratio where the upper end is several times the lower one.
double between(double low, double high) {
  constexpr double kSeveral = 3.0;
  return low > 0.0 && high > kSeveral * low ? std::sqrt(low * high) : 0.5 * (low + high);
}

/// The level where any filter's curve bends most; 0: none does.
std::size_t sharpest_bend(const SweepResult& sweep, const std::vector<double>& x) {
  std::size_t sharpest = 0;
  double most = 0.0;
  for (std::size_t filter = 0; filter < sweep.cells.front().ate_m.size(); ++filter) {
    const double height = height_of(sweep, filter);
    for (std::size_t i = 1; i + 1 < x.size(); ++i) {
      const Summary bend = bend_at(sweep, x, i, filter);
      const double part = std::abs(bend.mean) / height;
      if (!(std::abs(bend.mean) > bend.half_width) || !(part > most)) continue;
      most = part;
      sharpest = i;
    }
  }
  return sharpest;
}

}  // namespace

std::vector<double> numbers_of(const Variation& variation) {
  std::vector<double> numbers;
  for (const std::string& value : variation.values) {
    const auto number = finite_number_in(value);
    if (!number)
      throw std::runtime_error(
          fmt::format("--vary {}: expected numbers (got '{}')", variation.name(), value));
    numbers.push_back(*number);
  }
  return numbers;
}

std::optional<std::string> next_value(const SweepResult& sweep, bool is_whole) {
  const std::vector<double> x = numbers_of(sweep.variations.front());
  const std::size_t bend = sharpest_bend(sweep, x);
  if (bend == 0) return {};
  const bool is_left_wider = x[bend] - x[bend - 1] >= x[bend + 1] - x[bend];
  const std::size_t low = is_left_wider ? bend - 1 : bend;
  const double middle = between(x[low], x[low + 1]);
  std::string value = is_whole ? fmt::format("{:.0f}", middle) : fmt::format("{:.4g}", middle);
  const double number = numbers_of({{"value"}, {value}}).front();
  const bool is_new = number > x[low] && number < x[low + 1];
  return is_new ? std::optional(value) : std::nullopt;
}

}  // namespace stereobench::harness
