/// Everything that says whether a filter knows how wrong it is: one run, and all seeds together.
#pragma once

#include <array>
#include <span>

#include "harness/scoring/coverage.h"
#include "harness/scoring/innovations.h"
#include "harness/scoring/particle_set.h"
#include "harness/statistics/statistics.h"

namespace stereobench::harness {

/// One run's, beside its normalised errors.
struct ConsistencyScore {
  InnovationScore innovations;
  Coverage path;
  Coverage map;
  ParticleScore particles;
};

/// All seeds'. Each fraction is one number a seed: steps of one run are no repetitions.
struct ConsistencySummary {
  InnovationSummary innovations;
  std::array<Summary, kEllipses.size()> path;
  std::array<Summary, kEllipses.size()> map;
  Summary effective_mean;
  Summary effective_least;
  Summary resamplings;
  Summary ancestors_of_first;
  Summary ancestors_of_quarter;
};

ConsistencyScore score_consistency(const FilterRun& run, const MeasurementLog& log);

/// @param scores of the runs that did not fail
ConsistencySummary summarise(std::span<const ConsistencyScore> scores, Seeds seeds = Seeds::kWorlds);

}  // namespace stereobench::harness
