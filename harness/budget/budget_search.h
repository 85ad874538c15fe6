/// How bad something may get before a metric breaks its limit in too many worlds.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "harness/budget/quantile_bound.h"
#include "harness/experiment/types.h"

namespace stereobench::harness {

/// What is looked for: the worst level at which a metric keeps a limit in a share of worlds.
struct BudgetQuestion {
  std::vector<double> levels;        ///< from good to bad, at least two, each once
  std::vector<std::uint64_t> seeds;  ///< of the worlds, each once
  Gate limit;                        ///< of the metric, for each seed by itself
  WorldShare wanted;
  std::optional<long> too_many = {};  ///< seeds that fail, in place of what the share and the confidence say
};

/// Runs some seeds at a level. It may do so in any order or at once.
/// @return the metric's value for each seed, in their order; NaN: it has none, which breaks the limit
using MetricAtLevel =
    std::function<std::vector<double>(double level, const std::vector<std::uint64_t>& seeds)>;

/// One run: a seed at a level.
struct BudgetRun {
  double level = 0.0;
  std::uint64_t seed = 0;
  double value = 0.0;  ///< of the metric; NaN: none
};

enum class BudgetOutcome {
  kNone,        ///< the limit is broken at the good end already
  kFound,       ///< a level between the ends, or the good end
  kWholeRange,  ///< the bad end
};

/// How bad it may get.
struct Budget {
  BudgetOutcome outcome = BudgetOutcome::kNone;
  double level = 0.0;              ///< the worst at which it holds; the good end where it holds at none
  std::optional<double> fails_at;  ///< the next level, at which too many seeds fail; none at the bad end
  long may_fail = 0;               ///< seeds, for the share and the confidence
  long failing = 0;                ///< seeds that break the limit at `level`
  std::vector<double> values;      ///< of the metric at `level`, one a seed, in their order; NaN: none
  std::vector<BudgetRun> runs;     ///< all, in the order in which they were asked for
  long grid_runs = 0;              ///< that all seeds at all levels would have been
  /// Seeds that kept the limit at a worse level than one at which they broke it.
  std::vector<std::uint64_t> not_monotone;
};

/// @return whether a value keeps a limit; NaN does not
bool keeps_limit(const Gate& limit, double value);

/// Finds the worst level at which no more seeds break the limit than may (order_of_bound - 1).
///
/// A seed that keeps the limit at a level is taken to keep it at better ones, and one that breaks it to break
/// it at worse ones. So each seed has a threshold. The budget is the last level up to the k-th smallest of
/// these, which bounds the level that the share of worlds bears: it is beyond that level with a probability
/// of at most 1 - confidence, whatever the distribution of thresholds.
///
/// How near to that level it is depends on how much worlds differ. The rms of 50 independent errors differs
/// little: 59 seeds bring the bound within 6 % in median. Of errors that add up along a path, 59 seeds bring
/// it within 23 %, 361 within 10 % (tests/harness/budget/known_law_test.cpp).
///
/// Only seeds that failed are searched through, by bisection. What is found for them is tried on all seeds,
/// first on those of which least is known; those that fail join the search below. Seeds are run eight at a
/// time, and no longer than until it is clear whether too many fail. At the budget all seeds have really been
/// run: nothing of it rests on what was taken to be so.
/// @param run is called for 1 to 8 seeds that it was not asked for at that level
/// @return with the same runs in the same order for equal arguments
/// @throws std::runtime_error when the seeds are too few for the share and the confidence; what `run` throws;
///   std::invalid_argument when there are fewer than two levels, or `run` does not give a value a seed
Budget find_budget(const BudgetQuestion& question, const MetricAtLevel& run);

}  // namespace stereobench::harness
