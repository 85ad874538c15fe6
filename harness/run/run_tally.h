/// Seeds put together one after the other into what run.json says.
#pragma once

#include <string>
#include <vector>

#include "harness/run/run_result.h"
#include "harness/run/seed_result.h"

namespace stereobench::harness {

/// Adds seeds up. It keeps some numbers a seed, and no step of any: its size does not grow with their
/// product.
class RunTally {
 public:
  /// @param name of the scenario or the log
  /// @param backend what rendered, or kNoBackend
  /// @param seeds what the seeds differ in
  RunTally(std::string name, std::string backend, Seeds seeds = Seeds::kWorlds);

  /// Adds a seed; all have the same filters in the same order, and all a bound or none.
  /// @throws std::invalid_argument when it has other filters than the first
  void add(const SeedResult& seed);

  /// @throws std::invalid_argument when there is no seed
  RunResult result() const;

  /// Seconds of each stage, summed over the seeds.
  const Timing& timing() const { return timing_; }

 private:
  /// An estimator's runs so far.
  struct Estimator {
    int particles = 1;
    FilterTally scores;
    Efficiency efficiency;
    std::vector<double> ate_m;  ///< one a seed; NaN where the run failed
  };
  void add_run(std::size_t filter, const SeedResult& seed);
  std::vector<Comparison> compare() const;
  static void add_score(Estimator& estimator, const FilterScore& score,
                        const std::optional<BoundScores>& bounds, BoundScore BoundScores::*bound);
  FilterResult summary_of(FilterResult counted, const Estimator& estimator) const;

  RunResult result_;  ///< what is a plain sum over the seeds
  Seeds seeds_;
  std::vector<Estimator> filters_;
  Estimator batch_;
  Timing timing_;
};

}  // namespace stereobench::harness
