#include "harness/scoring/particle_set.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace stereobench::harness {

std::vector<int> distinct_ancestors(std::span<const std::vector<int>> ancestors_by_update, int particles) {
  std::vector<int> counts(ancestors_by_update.size());
  std::vector<int> alive(static_cast<std::size_t>(particles));  // sorted, each once
  std::iota(alive.begin(), alive.end(), 0);
  for (std::size_t update = ancestors_by_update.size(); update-- > 0;) {
    counts[update] = static_cast<int>(alive.size());
    const std::vector<int>& ancestors = ancestors_by_update[update];
    if (ancestors.empty()) continue;
    for (int& particle : alive) particle = ancestors[static_cast<std::size_t>(particle)];
    std::sort(alive.begin(), alive.end());
    alive.erase(std::unique(alive.begin(), alive.end()), alive.end());
  }
  return counts;
}

ParticleScore score_particles(const FilterRun& run, const MeasurementLog& log) {
  std::vector<const UpdateRecord*> updates;
  for (std::size_t k = 0; k < std::min(run.updates.size(), log.steps.size()); ++k)
    if (!log.steps[k].measurements.empty()) updates.push_back(&run.updates[k]);
  constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();
  if (updates.empty()) return {kNotKnown, kNotKnown, kNotKnown, kNotKnown, kNotKnown};
  ParticleScore score{.effective_least = std::numeric_limits<double>::infinity()};
  for (const UpdateRecord* update : updates) {
    score.effective_mean += update->effective_particles;
    score.effective_least = std::min(score.effective_least, update->effective_particles);
  }
  score.effective_mean /= static_cast<double>(updates.size());
  score.resamplings = static_cast<double>(run.last.counters.resamplings);
  score.ancestors_of_first = updates.front()->distinct_ancestors;
  score.ancestors_of_quarter = updates[updates.size() - 1 - updates.size() / 4]->distinct_ancestors;
  return score;
}

}  // namespace stereobench::harness
