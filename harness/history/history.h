/// What became of each metric over many results: its means, and the steps in them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "harness/regression/metric_rule.h"
#include "harness/regression/verdict.h"

namespace stereobench::harness {

/// A change of level from one result to the next.
struct HistoryStep {
  std::size_t result = 0;  ///< the first one behind the step, from 0
  double before = 0.0;  ///< the metric's mean over the seeds and the results from the step before to this one
  double after = 0.0;   ///< the same from this step to the next one
  double worse_by =
      0.0;         ///< in margins of the metric: above 0 it got worse, within -1 .. 1 it does not matter
  double p = 1.0;  ///< of no step, corrected for the number of metrics that changed and for parts

  bool is_worse() const { return worse_by > 1.0; }
  bool is_better() const { return worse_by < -1.0; }
};

/// One metric's.
struct MetricHistory {
  std::string metric;
  std::vector<double> means;       ///< one a result, over the seeds; NaN where a result has no value
  long seeds = 0;                  ///< that all results with a value have one of
  long lost = 0;                   ///< shared seeds that some of these results have no value of
  bool changed = false;            ///< on any of the seeds, by any bit
  std::vector<HistoryStep> steps;  ///< in the order of the results
};

struct HistorySettings {
  double alpha = 0.01;  ///< chance of any false step, all metrics together
  std::vector<Margin> margins;
  std::string only = "*";  ///< pattern of the metrics that are looked at
};

struct History {
  std::vector<std::uint64_t> seeds;    ///< that all results have, in ascending order
  std::vector<MetricHistory> metrics;  ///< those that are judged, by name
  long changed = 0;                    ///< metrics among which p-values are corrected
  long fewest_seeds = 0;               ///< below which no p-value of that many metrics can be small enough
};

/// Follows each metric that a rule judges over results, and finds its steps with find_changes.
///
/// Seeds are those that all results share. The chance of a false step is divided by the number of metrics
/// that changed (Bonferroni): where all seeds agree p-values are as small as seeds allow, and Holm's
/// correction would be no other. On recorded logs, a metric that is the same on all seeds of each result has
/// no chance in it: each of its changes is a step, with a p-value of 0.
/// @param results in their order
/// @throws std::runtime_error, one line, for less than two results, no shared seed, or no metric
History history_of(std::span<const SeedTable> results, const HistorySettings& settings);

/// The steps of all metrics, the worst first.
struct FoundStep {
  const MetricHistory* metric = nullptr;
  HistoryStep step;
};
std::vector<FoundStep> steps_of(const History& history);

/// @return whether a metric is worse in the last result than before its last step, by more than its margin
bool ends_worse(const History& history);

}  // namespace stereobench::harness
