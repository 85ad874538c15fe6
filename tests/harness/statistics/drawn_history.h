/// Made-up histories of an error, with and without a step.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "harness/statistics/change_point.h"

namespace stereobench::harness {

/// Each seed has a world, which all results share; worlds differ by 40 % (a standard deviation of the
/// logarithm).
struct DrawnHistory {
  std::size_t seeds = 15;
  std::size_t results = 12;
  double noise = 0.3;    ///< of a seed in a result: a standard deviation of the logarithm
  double changes = 1.0;  ///< share of the results that draw their noise anew; others repeat the one before
  double step = 1.0;     ///< factor of the errors from a result on
  std::size_t at = 6;    ///< that result, from 0
};

/// @return one series a seed. Equal arguments give equal bytes
std::vector<Series> draw_history(const DrawnHistory& kind, std::uint64_t key);

}  // namespace stereobench::harness
