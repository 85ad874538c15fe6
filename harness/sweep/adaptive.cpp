#include "harness/sweep/adaptive.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/io/number_table.h"
#include "harness/statistics/statistics.h"
#include "slam/math/elementary.h"

namespace stereobench::harness {
namespace {

/// Whether values are spread over decades: then their ratios count.
bool is_over_decades(const std::vector<double>& x) {
  constexpr double kDecade = 10.0;
  const auto lowest = std::ranges::find_if(x, [](double value) { return value > 0.0; });
  return x.front() >= 0.0 && lowest != x.end() && x.back() >= kDecade * *lowest;
}

/// Where values lie on the axis; -infinity for a 0 that stands apart.
std::vector<double> places_of(std::vector<double> x) {
  if (is_over_decades(x)) std::ranges::transform(x, x.begin(), slam::logarithm);
  return x;
}

/// The logarithms of a filter's mean ATE; NaN where it failed in all seeds.
std::vector<double> heights_of(const SweepResult& sweep, std::size_t filter) {
  std::vector<double> heights;
  for (const SweepCell& cell : sweep.cells)
    heights.push_back(slam::logarithm(summarise(cell.ate_m[filter]).mean));
  return heights;
}

/// The second derivative of the parabola through a point and its neighbours; not finite at both ends.
double curvature_at(const std::vector<double>& x, const std::vector<double>& y, std::size_t i) {
  if (i == 0 || i + 1 == x.size()) return std::numeric_limits<double>::quiet_NaN();
  const double before = (y[i] - y[i - 1]) / (x[i] - x[i - 1]);
  const double behind = (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
  return 2.0 * (behind - before) / (x[i + 1] - x[i - 1]);
}

/// How much a value between a pair is needed: by area, then by distance.
struct Need {
  double area = 0.0;
  double distance = 0.0;

  auto operator<=>(const Need&) const = default;
};

/// @param i the lower one of the pair
Need need_between(const std::vector<double>& x, const std::vector<std::vector<double>>& curves,
                  std::size_t i) {
  Need need{0.0, x[i + 1] - x[i]};
  if (!std::isfinite(need.distance)) return {};
  for (const std::vector<double>& y : curves)
    for (const std::size_t end : {i, i + 1}) {
      const double area =
          std::abs(curvature_at(x, y, end)) * need.distance * need.distance * need.distance / 12.0;
      if (std::isfinite(area)) need.area = std::max(need.area, area);
    }
  return need;
}

/// The value halfway between two places, as it is written.
std::string between(double low, double high, bool is_by_ratio, bool is_whole) {
  const double middle = is_by_ratio ? std::sqrt(low * high) : 0.5 * (low + high);
  return is_whole ? fmt::format("{:.0f}", middle) : fmt::format("{:.4g}", middle);
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
  const std::vector<double> values = numbers_of(sweep.variations.front());
  const std::vector<double> places = places_of(values);
  std::vector<std::vector<double>> curves;
  for (std::size_t filter = 0; filter < sweep.cells.front().ate_m.size(); ++filter)
    curves.push_back(heights_of(sweep, filter));
  std::optional<std::string> next;
  Need most;
  for (std::size_t i = 0; i + 1 < values.size(); ++i) {
    const std::string value = between(values[i], values[i + 1], is_over_decades(values), is_whole);
    const double number = numbers_of({{"value"}, {value}}).front();
    const bool is_new = number > values[i] && number < values[i + 1];
    const Need need = need_between(places, curves, i);
    if (!is_new || !(need > most)) continue;
    most = need;
    next = value;
  }
  return next;
}

}  // namespace stereobench::harness
