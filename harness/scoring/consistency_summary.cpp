#include "harness/scoring/consistency_summary.h"

#include <vector>

namespace stereobench::harness {

ConsistencyScore score_consistency(const FilterRun& run, const MeasurementLog& log) {
  return {score_innovations(run, log), cover_path(run, log), cover_map(run.last.landmarks, log.landmarks),
          score_particles(run, log)};
}

ConsistencySummary summarise(std::span<const ConsistencyScore> scores, Seeds seeds) {
  const auto over_seeds = [&](auto metric) {
    std::vector<double> values;
    for (const ConsistencyScore& score : scores) values.push_back(metric(score));
    return summarise(values);
  };
  std::vector<InnovationScore> innovations;
  for (const ConsistencyScore& score : scores) innovations.push_back(score.innovations);
  ConsistencySummary summary;
  summary.innovations = summarise(innovations, seeds);
  for (std::size_t i = 0; i < kEllipses.size(); ++i) {
    summary.path[i] = over_seeds([i](const ConsistencyScore& s) { return s.path.within[i]; });
    summary.map[i] = over_seeds([i](const ConsistencyScore& s) { return s.map.within[i]; });
  }
  const auto of_particles = [&](double ParticleScore::*part) {
    return over_seeds([part](const ConsistencyScore& s) { return s.particles.*part; });
  };
  summary.effective_mean = of_particles(&ParticleScore::effective_mean);
  summary.effective_least = of_particles(&ParticleScore::effective_least);
  summary.resamplings = of_particles(&ParticleScore::resamplings);
  summary.ancestors_of_first = of_particles(&ParticleScore::ancestors_of_first);
  summary.ancestors_of_quarter = of_particles(&ParticleScore::ancestors_of_quarter);
  return summary;
}

}  // namespace stereobench::harness
