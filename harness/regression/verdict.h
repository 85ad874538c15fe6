/// What changed between two results, metric by metric, on the same seeds.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "harness/regression/metric_rule.h"
#include "harness/run/seed_metrics.h"
#include "harness/statistics/bootstrap.h"
#include "harness/statistics/paired.h"

namespace stereobench::harness {

enum class Verdict {
  kRegressed,     ///< significantly worse, by more than the margin
  kVanished,      ///< the second result has no value any more
  kInconclusive,  ///< more seeds are needed
  kImproved,      ///< significantly better, by more than the margin
  kNew,           ///< the first result had no value
  kPass,          ///< equal, or the interval of the change lies within the margin
};

/// "REGRESSED" and so on, as tables and files have it.
const char* text_of(Verdict verdict);

/// The seeds of a result, and its metrics in their order.
struct SeedTable {
  std::vector<std::uint64_t> seeds;
  SeedMetrics metrics;
};

/// One metric's. The change is that of badness(): positive is worse.
struct MetricVerdict {
  std::string metric;
  Verdict verdict = Verdict::kPass;
  long pairs = 0;           ///< seeds that both results have a value of
  bool equal = false;       ///< on all of them, to the last bit
  double first_mean = 0.0;  ///< over the pairs; NaN where there is none, and so below
  double second_mean = 0.0;
  double change = 0.0;  ///< mean over the pairs
  Interval interval;    ///< of the change
  double margin = 0.0;  ///< in the unit of the change
  double scale = 0.0;   ///< what a relative margin is a share of; 0 for one in the unit of the change
  double p = 1.0;       ///< of no change: Wilcoxon's signed ranks, or McNemar's test
  double p_holm = 1.0;  ///< the same among all metrics that changed
  std::optional<PairedCount> count;  ///< of a rate: what came out differently
  std::optional<long> more_seeds;    ///< of an inconclusive one: about how many decide
};

struct VerdictSettings {
  double alpha = 0.01;  ///< chance of any false REGRESSED or IMPROVED, all metrics together
  std::vector<Margin> margins;
  std::string only = "*";  ///< pattern of the metrics that are judged
};

/// Counts by the name of their metric.
using PairedCounts = std::map<std::string, PairedCount>;

/// Two results beside each other.
struct ResultComparison {
  std::vector<std::uint64_t> seeds;     ///< that both have, in ascending order
  std::vector<MetricVerdict> metrics;   ///< by verdict, then by name
  std::vector<std::string> conditions;  ///< numbers that are neither good nor bad, and differ
  long changed = 0;                     ///< metrics among which p-values are corrected

  bool has(Verdict verdict) const;
};

/// Judges each metric on the seeds that both results have.
///
/// REGRESSED is a metric whose p-value is below alpha, corrected by Holm for all metrics that changed, and
/// whose whole interval (of probability 1 - alpha) is worse than the margin; IMPROVED the same on the other
/// side. PASS is one whose whole interval lies within the margins. All others are INCONCLUSIVE.
/// @param counts of metrics that are rates: what came out differently, which tells more than rates of seeds.
/// Their p-value is McNemar's
/// @throws std::runtime_error, one line, when there is no seed or no metric to compare
ResultComparison compare_results(const SeedTable& first, const SeedTable& second,
                                 const VerdictSettings& settings, const PairedCounts& counts = {});

}  // namespace stereobench::harness
