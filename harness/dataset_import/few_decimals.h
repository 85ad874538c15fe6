/// Numbers that were short before something was computed with them.
#pragma once

#include <cmath>

namespace stereobench::harness {

/// A number that went through others is off by its last digits.
/// @param rounding by how much it may be off
/// @return that of the fewest decimals, at most nine, that it is but for these; else itself
inline double in_few_decimals(double value, double rounding) {
  constexpr double kMostParts = 1e9;
  for (double parts = 1.0; parts <= kMostParts; parts *= 10.0) {
    const double shorter = std::round(value * parts) / parts;
    if (std::abs(shorter - value) <= rounding) return shorter + 0.0;  // -0 becomes 0
  }
  return value;
}

/// By how much a few sums and products of numbers may be off.
/// @param largest of the numbers, as amount
inline double rounding_of(double largest) {
  constexpr double kOfOne = 1e-14;
  return kOfOne * (1.0 + largest);
}

}  // namespace stereobench::harness
