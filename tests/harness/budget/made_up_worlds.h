/// Worlds whose thresholds are known: what a search is held against.
#pragma once

#include <algorithm>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "harness/budget/budget_search.h"

namespace stereobench::harness {

/// Runs that are made up, and what was asked of them.
struct MadeUpWorlds {
  std::function<double(double level, std::uint64_t seed)> metric;
  std::set<std::pair<double, std::uint64_t>> asked = {};
  std::size_t largest_chunk = 0;
  bool asked_twice = false;

  std::vector<double> operator()(double level, const std::vector<std::uint64_t>& seeds) {
    std::vector<double> values;
    for (const std::uint64_t seed : seeds) {
      asked_twice = !asked.emplace(level, seed).second || asked_twice;
      values.push_back(metric(level, seed));
    }
    largest_chunk = std::max(largest_chunk, seeds.size());
    return values;
  }
};

/// first, first + 1, ...
inline std::vector<std::uint64_t> seeds_from(std::uint64_t first, std::size_t count) {
  std::vector<std::uint64_t> seeds;
  for (std::size_t i = 0; i < count; ++i) seeds.push_back(first + i);
  return seeds;
}

}  // namespace stereobench::harness
