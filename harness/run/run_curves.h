/// What pictures and pages show of a run beside its metrics: the first seed, and sums over the seeds.
#pragma once

#include <vector>

#include "harness/frames/kept_pair.h"
#include "harness/report/error_picture.h"
#include "harness/run/seed_result.h"

namespace stereobench::harness {

/// So many stereo pairs are kept of a run.
inline constexpr std::size_t kMostPairs = 24;

/// Its size does not grow with the product of seeds and steps.
struct RunCurves {
  SeedResult first;                 ///< the first seed, without its lines and its pairs
  std::vector<ErrorCurves> errors;  ///< one a filter
  std::vector<double> bound_m2;     ///< variance of the position by the filtering bound, one a step; a sum
  std::vector<std::vector<SquaredSum>> innovations;  ///< one a filter and step
  WorstPairs worst_pairs{kMostPairs};                ///< of all seeds
  std::size_t seeds = 0;

  /// Adds a seed; all have the same filters in the same order.
  void add(const SeedResult& seed);

  /// The least rms error of position that is possible, at each step, m; empty where it is not known.
  std::vector<double> bound_m() const;
};

}  // namespace stereobench::harness
