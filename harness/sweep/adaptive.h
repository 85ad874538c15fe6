/// Where a sweep should look next: between two values, where the line between them says least of a curve.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/sweep/sweep_result.h"

namespace stereobench::harness {

/// The numbers that a variation's values are. @throws std::runtime_error for a value that is none
std::vector<double> numbers_of(const Variation& variation);

/// A value between two neighbours at which the ATE of the filters is to be found out next.
///
/// Of each filter's curve, the area between it and the line through two neighbours is estimated as |f''| h^3
/// / 12. h is their distance. f'' is that of the parabola through a value and its neighbours, the larger of
/// both ends. f is the logarithm of the mean ATE over seeds. The pair with the largest area gets the value
/// between them; where no curve bends, the pair that is farthest apart. Where the highest value is ten times
/// the lowest above 0 or more, distances are those of logarithms, and no value is put between 0 and the next
/// one.
///
/// Chance bends curves, too. It is not tested for: where values are close, h^3 is small, and so is the area.
/// docs/results.md compares with evenly spaced values.
/// @param sweep of one variation of numbers, with at least three cells, by ascending value
/// @param is_whole whether the key takes whole numbers
/// @return to 4 significant digits; none where no new value is left
std::optional<std::string> next_value(const SweepResult& sweep, bool is_whole);

}  // namespace stereobench::harness
