/// Everything that says whether a filter knows how wrong it is: one run, and all seeds together.
#pragma once

#include <array>
#include <vector>

#include "harness/scoring/coverage.h"
#include "harness/scoring/innovations.h"
#include "harness/scoring/particle_set.h"
#include "harness/statistics/statistics.h"

namespace stereobench::harness {

/// One run's, beside its normalised errors.
struct ConsistencyScore {
  InnovationScore innovations;
  EllipseCoverage path;
  EllipseCoverage map;
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

/// Puts runs that did not fail together, seed by seed. It keeps some numbers a run.
class ConsistencyTally {
 public:
  void add(const ConsistencyScore& score);
  ConsistencySummary summary(Seeds seeds = Seeds::kWorlds) const;

 private:
  InnovationTally innovations_;
  std::vector<ParticleScore> particles_;
  std::array<std::vector<double>, kEllipses.size()> path_;
  std::array<std::vector<double>, kEllipses.size()> map_;
};

}  // namespace stereobench::harness
