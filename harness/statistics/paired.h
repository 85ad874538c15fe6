/// Whether one filter is better than another on the same worlds: differences seed by seed.
#pragma once

#include <span>

#include "harness/statistics/bootstrap.h"
#include "harness/statistics/statistics.h"

namespace stereobench::harness {

/// Two filters' errors over the same seeds. Both saw the same worlds, odometry and sightings, so that what
/// the seeds have in common cancels; where it does not, the interval says so.
struct PairedDifference {
  Summary
      difference;  ///< of the first minus the second, over seeds that have both; below 0: the first is better
  double p_value = 1.0;  ///< of no difference, two-sided, by Wilcoxon's signed ranks; 1 where nothing differs
};

/// Compares two filters.
/// @param first one value a seed; NaN stands for a run that could not be scored
/// @param second of the same seeds, in the same order
/// @throws std::invalid_argument when their numbers differ
PairedDifference compare_paired(std::span<const double> first, std::span<const double> second);

/// The probability of signed ranks at least as lopsided as these when nothing but chance decides the signs
/// (Wilcoxon 1945). Exact below 51 differences, of which equal ones share their mean rank; otherwise the
/// normal approximation with its corrections for ties and continuity. Zeros are left out.
/// @return in (0, 1]
double wilcoxon_signed_rank(std::span<const double> differences);

/// Of many things that were tried twice, those that came out differently.
struct PairedCount {
  long worse = 0;   ///< that came out right the first time alone
  long better = 0;  ///< that came out right the second time alone
  long total = 0;   ///< that were tried
};

/// The probability of counts at least as lopsided as these when nothing but chance decides which time comes
/// out right: McNemar's test, exact, two-sided.
/// @return in (0, 1]; 1 where nothing differs
double mcnemar(const PairedCount& count);

/// The interval of how much larger the share of things that come out wrong is the second time: all values
/// that a score test at the probability's level does not refuse (Tango, Statistics in Medicine 17, 1998).
/// @param count whose total is at least 1
/// @param probability in (0, 1)
/// @return within [-1, 1]
Interval paired_share_interval(const PairedCount& count, double probability);

}  // namespace stereobench::harness
