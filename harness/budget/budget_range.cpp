#include "harness/budget/budget_range.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "harness/io/number_table.h"

namespace stereobench::harness {
namespace {

constexpr double kLeastShareOfRange = 1e-4;  ///< levels need not be nearer to each other
constexpr double kLeastTolerance = 1e-3;
constexpr double kMostTolerance = 0.5;
constexpr double kSameDigits = 1e-9;  ///< ends are one number where they differ by less of their size

void check_range(const BudgetRange& range) {
  const double size = std::max(std::abs(range.low), std::abs(range.high));
  if (!(std::abs(range.high - range.low) > kSameDigits * size))
    throw std::runtime_error(fmt::format("--vary: {}: expected two ends that differ, got {}..{}", range.key,
                                         range.low, range.high));
  const auto is_fractional = [](double end) { return end != std::round(end); };
  if (range.is_whole && (is_fractional(range.low) || is_fractional(range.high)))
    throw std::runtime_error(fmt::format("--vary: {}: expected whole numbers at both ends, got {}..{}",
                                         range.key, range.low, range.high));
}

/// multiple * 10^exponent
struct DecimalStep {
  double multiple = 1.0;
  int exponent = 0;

  double times(double count) const;
};

double power_of_ten(int exponent) {
  double power = 1.0;
  for (int i = 0; i < std::abs(exponent); ++i) power *= 10.0;
  return exponent < 0 ? 1.0 / power : power;
}

/// The decimal number's nearest double: whole numbers and their quotient are exact.
double DecimalStep::times(double count) const {
  const double digits = count * multiple;
  return exponent < 0 ? digits / power_of_ten(-exponent) : digits * power_of_ten(exponent);
}

/// The longest round step that is not above a length > 0.
DecimalStep step_not_above(double length) {
  int exponent = 0;
  while (power_of_ten(exponent) > length) --exponent;
  while (power_of_ten(exponent + 1) <= length) ++exponent;
  for (const double multiple : {5.0, 2.0})
    if (DecimalStep{multiple, exponent}.times(1.0) <= length) return {multiple, exponent};
  return {1.0, exponent};
}

/// The next multiple of a step, upwards or downwards, that is more than a hundredth of the step away.
double next_multiple(double from, const DecimalStep& step, bool is_upwards) {
  constexpr double kApart = 0.01;
  const double count = from / step.times(1.0);
  return step.times(is_upwards ? std::ceil(count + kApart) : std::floor(count - kApart)) + 0.0;  // no -0
}

std::vector<double> levels_of_range(const BudgetRange& range, double tolerance) {
  check_range(range);
  const bool is_upwards = range.high > range.low;
  const double least =
      std::max(kLeastShareOfRange * std::abs(range.high - range.low), range.is_whole ? 1.0 : 0.0);
  std::vector<double> levels;
  for (double level = range.low; is_upwards ? level < range.high : level > range.high;) {
    levels.push_back(level);
    const double size = std::min(std::abs(level - range.low), std::abs(level));
    level = next_multiple(level, step_not_above(std::max(tolerance * size, least)), is_upwards);
  }
  levels.push_back(range.high);
  return levels;
}

double with_nine_digits(double value) {
  return finite_number_in(fmt::format("{:.9g}", value)).value();
}

}  // namespace

BudgetRange parse_budget_range(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::size_t dots = equals == std::string::npos ? equals : text.find("..", equals);
  if (equals == 0 || dots == std::string::npos)
    throw std::runtime_error("--vary: expected KEY=LOW..HIGH, got " + text);
  const std::string_view ends = text;
  const auto low = finite_number_in(ends.substr(equals + 1, dots - equals - 1));
  const auto high = finite_number_in(ends.substr(dots + 2));
  if (!low || !high)
    throw std::runtime_error("--vary: expected numbers at both ends of KEY=LOW..HIGH, got " + text);
  const BudgetRange range{.key = text.substr(0, equals), .low = *low, .high = *high};
  check_range(range);
  return range;
}

std::vector<double> budget_levels(const BudgetMix& mix, double tolerance) {
  if (mix.empty() || !(tolerance >= kLeastTolerance && tolerance <= kMostTolerance))
    throw std::invalid_argument("a budget needs a line, and a tolerance in [0.001, 0.5]");
  if (mix.size() == 1) return levels_of_range(mix.front(), tolerance);
  for (const BudgetRange& range : mix) check_range(range);
  return levels_of_range({.key = name_of(mix), .low = 0.0, .high = 1.0}, tolerance);
}

double value_at(const BudgetMix& mix, const BudgetRange& range, double level) {
  if (mix.size() == 1) return level;
  const double way = with_nine_digits(level * (range.high - range.low));
  return range.is_whole ? range.low + std::trunc(way) : with_nine_digits(range.low + way);
}

std::vector<std::string> overrides_at(const BudgetMix& mix, double level) {
  std::vector<std::string> overrides;
  for (const BudgetRange& range : mix)
    overrides.push_back(fmt::format("{}={}", range.key, value_at(mix, range, level)));
  return overrides;
}

std::string name_of(const BudgetMix& mix) {
  std::string name = mix.front().key;
  for (std::size_t i = 1; i < mix.size(); ++i) name += (i + 1 < mix.size() ? ", " : " and ") + mix[i].key;
  return name;
}

}  // namespace stereobench::harness
