/// A bound of a quantile from a sample of any distribution: order statistics.
#pragma once

#include <string>

namespace stereobench::harness {

/// A share of all worlds, and how sure a statement about it has to be.
struct WorldShare {
  double share = 0.95;       ///< of the worlds in which something holds, in (0, 1)
  double confidence = 0.95;  ///< probability that the statement is right, in (0, 1)
};

/// Which of the thresholds of some worlds bounds the level that a share of all worlds bears.
///
/// A world's threshold is the level up to which something holds in it. Of n independent worlds, the k-th
/// smallest threshold is at most the (1 - share) quantile of thresholds with the probability
/// P(Binomial(n, 1 - share) >= k), whatever their distribution (Wilks, Annals of Mathematical Statistics 12,
/// 1941).
/// @param worlds n, >= 0
/// @return the largest k of which this probability is at least the confidence; 0: n worlds are too few
/// @throws std::invalid_argument when the share or the confidence is not in (0, 1)
long order_of_bound(long worlds, const WorldShare& wanted);

/// The fewest worlds of which order_of_bound is not 0: 59 for 95 % of worlds with 95 % confidence.
/// @throws std::invalid_argument as order_of_bound
long fewest_worlds(const WorldShare& wanted);

/// Makes sure that a number of seeds can answer. @return order_of_bound of them
/// @throws std::runtime_error that says how many are needed
long order_of_seeds(long seeds, const WorldShare& wanted);

/// "at least 95 % of worlds, with 95 % confidence"
std::string in_words(const WorldShare& wanted);

}  // namespace stereobench::harness
