#include "harness/scoring/consistency_summary.h"

namespace stereobench::harness {

ConsistencyScore score_consistency(const FilterRun& run, const MeasurementLog& log) {
  return {score_innovations(run, log), cover_path(run, log), cover_map(run.last.landmarks, log.landmarks),
          score_particles(run, log)};
}

void ConsistencyTally::add(const ConsistencyScore& score) {
  innovations_.add(score.innovations);
  particles_.push_back(score.particles);
  for (std::size_t i = 0; i < kEllipses.size(); ++i) {
    path_[i].push_back(score.path.within[i]);
    map_[i].push_back(score.map.within[i]);
  }
}

ConsistencySummary ConsistencyTally::summary(Seeds seeds) const {
  ConsistencySummary summary;
  summary.innovations = innovations_.summary(seeds);
  for (std::size_t i = 0; i < kEllipses.size(); ++i) {
    summary.path[i] = summarise(path_[i]);
    summary.map[i] = summarise(map_[i]);
  }
  const auto of_particles = [&](double ParticleScore::*part) {
    std::vector<double> values;
    for (const ParticleScore& score : particles_) values.push_back(score.*part);
    return summarise(values);
  };
  summary.effective_mean = of_particles(&ParticleScore::effective_mean);
  summary.effective_least = of_particles(&ParticleScore::effective_least);
  summary.resamplings = of_particles(&ParticleScore::resamplings);
  summary.ancestors_of_first = of_particles(&ParticleScore::ancestors_of_first);
  summary.ancestors_of_quarter = of_particles(&ParticleScore::ancestors_of_quarter);
  return summary;
}

}  // namespace stereobench::harness
