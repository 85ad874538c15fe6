/// How much each of several factors does to a metric, over everything that the others may be.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "harness/sensitivity/factors.h"
#include "harness/sensitivity/pick_freeze.h"
#include "harness/sensitivity/sobol_indices.h"

namespace stereobench::harness {

/// The metric at each of many points; NaN where the run failed.
using MetricAt = std::function<std::vector<double>(const std::vector<StudyPoint>& points)>;

struct StudySettings {
  std::size_t samples = 256;  ///< rows: each is a run for every factor and two more; 16 to 1,000,000
  double level = 0.95;        ///< of the intervals, 0.5 to 0.99
  std::uint64_t seed = 0;     ///< of the points, of their seeds and of the intervals
};

/// @throws std::runtime_error with a line that names the option, what was expected and what was got
void check(const StudySettings& settings);

/// A study and what it found.
struct Sensitivity {
  std::string scenario;
  std::string metric;
  Factors factors;
  StudySettings settings;
  SobolIndices indices;
};

/// Evaluates the metric at count_of_points() points, all in one call, and takes its variance apart.
/// @param metric_at returns one value a point, in their order
/// @return without names of scenario and metric. Equal arguments give equal bytes
/// @throws std::runtime_error as the checks of factors and settings
/// @throws std::invalid_argument when there are more or fewer values than points
Sensitivity study_sensitivity(const Factors& factors, const StudySettings& settings,
                              const MetricAt& metric_at);

/// The factors by their total index, the largest first; those without one are last.
std::vector<std::size_t> order_by_total(const SobolIndices& indices);

}  // namespace stereobench::harness
