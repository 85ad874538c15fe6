/// What changed between two results, metric by metric, on the same seeds.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/regression/metric_rule.h"
#include "harness/run/seed_metrics.h"
#include "harness/statistics/bootstrap.h"
#include "harness/statistics/paired.h"

namespace stereobench::harness {

enum class Verdict {
  kRegressed,     ///< significantly worse, by more than the margin
  kVanished,      ///< the second result has no value where the first has one
  kInconclusive,  ///< more seeds are needed
  kImproved,      ///< significantly better, by more than the margin
  kNew,           ///< the first result had no value
  kPass,          ///< equal, or the interval of the change lies within the margin
};

/// "REGRESSED" and so on, as tables and files have it.
const char* text_of(Verdict verdict);

/// How a p-value was found.
enum class ChangeTest {
  kNone,      ///< there was nothing to test
  kWilcoxon,  ///< signed ranks of the seeds' changes
  kMcnemar,   ///< counts of single balls
  kExact,     ///< no chance is at work: on one log a filter without random numbers gives the same each time
};

/// The seeds of a result, and its metrics in their order.
struct SeedTable {
  std::vector<std::uint64_t> seeds;
  SeedMetrics metrics;
  bool is_one_log = false;  ///< seeds are repetitions of the filters on one recorded log
};

/// One metric's. The change is that of badness() of the means: positive is worse.
struct MetricVerdict {
  std::string metric;
  Verdict verdict = Verdict::kPass;
  long pairs = 0;           ///< seeds that both results have a value of
  long lost = 0;            ///< seeds that the first result alone has a value of
  bool equal = false;       ///< on all seeds, to the last bit
  double first_mean = 0.0;  ///< over the pairs; NaN where there is none, and so below
  double second_mean = 0.0;
  double change = 0.0;
  Interval interval;    ///< of the change
  double margin = 0.0;  ///< in the unit of the change
  double scale = 0.0;   ///< what a relative margin is a share of; 0 for an absolute margin
  ChangeTest test = ChangeTest::kNone;
  double p = 1.0;                    ///< of no change
  double p_holm = 1.0;               ///< the same, corrected for all metrics that changed
  std::optional<PairedCount> count;  ///< what McNemar's test counted
  std::optional<long> more_seeds;    ///< of an inconclusive one: about how many decide
};

struct VerdictSettings {
  double alpha = 0.01;  ///< chance of any false REGRESSED or IMPROVED, all metrics together
  std::vector<Margin> margins;
  std::vector<std::string> only;  ///< patterns of the metrics that are judged; empty: all
};

/// What a metric counts.
struct MetricCount {
  PairedCount count;
  bool is_rate = true;  ///< the metric is a share of all; else the mean number in a seed
};

/// Counts by the name of their metric.
using PairedCounts = std::map<std::string, MetricCount>;

/// Two results beside each other.
struct ResultComparison {
  std::vector<std::uint64_t> seeds;     ///< that both have, in ascending order
  std::vector<MetricVerdict> metrics;   ///< by verdict, then from the pictures to the map (rank_of)
  std::vector<std::string> not_judged;  ///< metrics that no rule calls better or worse, and that differ
  long changed = 0;                     ///< metrics among which p-values are corrected
  long fewest_seeds = 0;                ///< below which no p-value of that many metrics can be small enough

  bool has(Verdict verdict) const;
};

/// Judges each metric on the seeds that both results have.
///
/// REGRESSED is a metric whose p-value is below alpha, corrected for all metrics that changed, and whose
/// whole interval (of probability 1 - alpha, at most 0.9999) is worse than the margin; IMPROVED the same on
/// the other side. Metrics are three families, of which each has an equal share of alpha, corrected by Holm
/// within: counts of detections, errors of detections, and SLAM. PASS is one whose whole interval lies within
/// the margins. VANISHED is one that the second result has no value of at a seed where the first has one. All
/// others are INCONCLUSIVE.
/// @param counts of metrics that count single things, such as balls. Their p-value is McNemar's and their
/// interval Tango's, which take each of them for independent
/// @throws std::runtime_error, one line, when there is no seed or no metric to compare,
ResultComparison compare_results(const SeedTable& first, const SeedTable& second,
                                 const VerdictSettings& settings, const PairedCounts& counts = {});

/// @throws std::runtime_error for a margin that is of no metric that was judged
void check_margins(const ResultComparison& comparison, const std::vector<Margin>& margins);

}  // namespace stereobench::harness
