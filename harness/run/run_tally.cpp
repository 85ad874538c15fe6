#include "harness/run/run_tally.h"

#include <stdexcept>
#include <utility>

#include "harness/scoring/association_score.h"

namespace stereobench::harness {

RunTally::RunTally(std::string name, std::string backend, Seeds seeds)
    : result_{.name = std::move(name), .backend = std::move(backend), .batch = {.filter = "batch"}},
      seeds_(seeds) {
  if (result_.backend != kNoBackend) result_.blur.emplace();
}

void RunTally::add(const SeedResult& seed) {
  if (result_.seeds.empty()) {
    result_.detector = seed.detector;
    for (const ScoredRun& run : seed.runs) {
      result_.filters.push_back({.filter = run.filter});
      filters_.push_back({.particles = run.particles});
    }
  }
  if (seed.runs.size() != filters_.size())
    throw std::invalid_argument("RunTally: the seeds have different filters");
  result_.seeds.push_back(seed.seed);
  if (seed.vision && !result_.vision) result_.vision.emplace();
  if (seed.vision) *result_.vision += *seed.vision;
  if (seed.faults) result_.faults = result_.faults.value_or(FaultCounts{});
  if (seed.faults) *result_.faults += *seed.faults;
  if (result_.blur) *result_.blur += seed.blur;
  result_.start_is_true = result_.start_is_true && seed.start_is_true;
  result_.identities_known = result_.identities_known && seed.identities_known;
  for (std::size_t i = 0; i < seed.runs.size(); ++i) add_run(i, seed);
  add_score(batch_, seed.batch, seed.bound, &BoundScores::smoothing);
  if (seed.bound) result_.bounds.push_back(*seed.bound);
  for (const auto& [stage, seconds] : seed.timing) timing_[stage] += seconds;
}

void RunTally::add_run(std::size_t filter, const SeedResult& seed) {
  const ScoredRun& run = seed.runs[filter];
  add_score(filters_[filter], run.score, seed.bound, &BoundScores::filtering);
  FilterResult& counted = result_.filters[filter];
  counted.counters += run.counters;
  if (run.association)
    counted.association = counted.association.value_or(AssociationScore{}) + *run.association;
  if (!run.score.failed) counted.innovations.push_back({seed.seed, run.score.consistency.innovations.run});
}

void RunTally::add_score(Estimator& estimator, const FilterScore& score,
                         const std::optional<BoundScores>& bounds, BoundScore BoundScores::*bound) {
  estimator.scores.add(score);
  estimator.ate_m.push_back(score.trajectory.ate_rms_m);
  if (bounds) estimator.efficiency.add(score, *bounds.*bound);
}

FilterResult RunTally::summary_of(FilterResult counted, const Estimator& estimator) const {
  counted.summary = estimator.scores.summary(estimator.particles, seeds_);
  counted.efficiency = estimator.efficiency.ratio();
  return counted;
}

std::vector<Comparison> RunTally::compare() const {
  std::vector<Comparison> comparisons;
  for (std::size_t i = 0; i < filters_.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const std::string& filter = result_.filters[i].filter;
      const std::string& other = result_.filters[j].filter;
      if (filter != kBaseline && other != kBaseline)
        comparisons.push_back({filter, other, compare_paired(filters_[i].ate_m, filters_[j].ate_m)});
    }
  return comparisons;
}

RunResult RunTally::result() const {
  if (result_.seeds.empty()) throw std::invalid_argument("RunTally: there is no seed");
  RunResult result = result_;
  result.batch = summary_of(result_.batch, batch_);
  for (std::size_t i = 0; i < filters_.size(); ++i)
    result.filters[i] = summary_of(result_.filters[i], filters_[i]);
  result.comparisons = compare();
  return result;
}

}  // namespace stereobench::harness
