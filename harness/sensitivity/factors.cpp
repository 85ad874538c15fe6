#include "harness/sensitivity/factors.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "harness/io/number_table.h"
#include "slam/math/elementary.h"

namespace stereobench::harness {
namespace {

std::optional<Spacing> spacing_in(std::string_view word) {
  if (word.empty()) return Spacing::kEven;
  if (word == ":log") return Spacing::kLogarithmic;
  if (word == ":whole") return Spacing::kWhole;
  return {};
}

bool is_whole(double number) {
  return std::trunc(number) == number;
}

/// What is wrong with a range; empty when nothing is.
std::string fault_of(const KeyRange& range) {
  if (!(range.low < range.high)) return "low below high";
  if (range.spacing == Spacing::kLogarithmic && !(range.low > 0.0)) return "numbers above 0 before :log";
  if (range.spacing == Spacing::kWhole && !(is_whole(range.low) && is_whole(range.high)))
    return "whole numbers before :whole";
  return "";
}

}  // namespace

KeyRange parse_key_range(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos)
    throw std::runtime_error(fmt::format("--vary: expected key=low..high, got '{}'", text));
  const std::string key = text.substr(0, equals);
  const std::string_view values = std::string_view(text).substr(equals + 1);
  const std::size_t dots = values.find("..");
  const std::size_t colon = std::min(values.find(':'), values.size());
  const std::optional<Spacing> spacing = spacing_in(values.substr(colon));
  std::optional<double> low, high;
  if (dots != std::string_view::npos && dots < colon) {
    low = finite_number_in(values.substr(0, dots));
    high = finite_number_in(values.substr(dots + 2, colon - dots - 2));
  }
  if (!low || !high || !spacing)
    throw std::runtime_error(fmt::format(
        "--vary {}: expected low..high, low..high:log or low..high:whole, got '{}'", key, values));
  KeyRange range{key, *low, *high, *spacing};
  if (const std::string fault = fault_of(range); !fault.empty())
    throw std::runtime_error(fmt::format("--vary {}: expected {}, got '{}'", key, fault, values));
  return range;
}

double value_at(const KeyRange& range, double share) {
  switch (range.spacing) {
    case Spacing::kLogarithmic:
      return std::clamp(range.low * slam::exponential(share * slam::logarithm(range.high / range.low)),
                        range.low, range.high);
    case Spacing::kWhole:
      return range.low + std::floor(share * (range.high - range.low + 1.0));
    case Spacing::kEven:
      break;
  }
  return range.low + share * (range.high - range.low);
}

const std::string& Factors::name(std::size_t index) const {
  return index < keys.size() ? keys[index].key : streams.at(index - keys.size());
}

std::string Factors::values(std::size_t index) const {
  if (index >= keys.size()) return "random numbers";
  const KeyRange& range = keys[index];
  const char* spacing = range.spacing == Spacing::kLogarithmic ? ", logarithmic"
                        : range.spacing == Spacing::kWhole     ? ", whole"
                                                               : "";
  return fmt::format("{} to {}{}", range.low, range.high, spacing);
}

void check(const Factors& factors) {
  if (factors.size() == 0) throw std::runtime_error("--vary: expected at least one key=low..high");
  std::set<std::string> names;
  for (std::size_t i = 0; i < factors.size(); ++i)
    if (!names.insert(factors.name(i)).second)
      throw std::runtime_error(fmt::format("--vary: {} is varied twice", factors.name(i)));
}

}  // namespace stereobench::harness
