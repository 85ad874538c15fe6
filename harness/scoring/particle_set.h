/// How well a set of particles stands for what the filter believes.
#pragma once

#include <span>
#include <vector>

#include "harness/types.h"

namespace stereobench::harness {

/// One run's particles; NaN where nothing was ever seen.
struct ParticleScore {
  double effective_mean = 0.0;   ///< of the updates' effective particles, before each resampled
  double effective_least = 0.0;  ///< of the worst update
  double resamplings = 0.0;
  double ancestors_of_first = 0.0;    ///< distinct particles of the first update with descendants in the end
  double ancestors_of_quarter = 0.0;  ///< the same of the update a quarter of all updates before the last
};

/// How many different particles of each update have descendants among those of the last.
///
/// Particles that share an ancestor share their path up to it: once all descend from one, nothing that is
/// seen later can choose between pasts any more.
///
/// @param ancestors_by_update as slam::UpdateReport tells them, in order of time: of each particle that the
///   update left, its index among those that the update found; empty where particles were not resampled
/// @param particles how many there are
/// @return one an update, counted among the particles that it left
std::vector<int> distinct_ancestors(std::span<const std::vector<int>> ancestors_by_update, int particles);

/// @param log whose steps say at which of them there was something to update with
ParticleScore score_particles(const FilterRun& run, const MeasurementLog& log);

}  // namespace stereobench::harness
