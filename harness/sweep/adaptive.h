/// Where a sweep should look next: at a value between two others, where a curve bends.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/sweep/sweep_result.h"

namespace stereobench::harness {

/// The numbers that a variation's values are. @throws std::runtime_error for a value that is none
std::vector<double> numbers_of(const Variation& variation);

/// A value between two neighbours at which some filter's ATE is to be found out next.
///
/// A curve bends at a value by how far its ATE is from the line through both neighbours, seed by seed. The
/// largest bend, as a part of the curve's whole height, is refined on its wider side. A bend whose 95 %
/// interval over the seeds holds 0 is none.
/// @param sweep of one variation of numbers, with at least three cells, by ascending value
/// @param is_whole whether the key takes whole numbers
/// @return to 4 significant digits; none where no curve bends, or no new value is left
std::optional<std::string> next_value(const SweepResult& sweep, bool is_whole);

}  // namespace stereobench::harness
