/// Where a series of results changed: a step is what seeds do alike.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace stereobench::harness {

/// The values of one seed, a result after the other.
using Series = std::vector<double>;

struct ChangePoint {
  std::size_t place = 0;  ///< the first result behind the change
  double p = 1.0;         ///< the probability of as clear a change anywhere where there is none
};

/// The clearest change of level in a series of results.
///
/// At each place two statistics say how alike the seeds change: signed ranks of the differences between both
/// neighbours, as Wilcoxon has them, and the sum over the seeds of the CUSUM of the seed's ranks among its
/// own results (the correlation of the ranks with a step at the place). Each has a variance of 1 when signs
/// are left to chance. The statistic is the largest of all. Its p-value is the share of sign flips of whole
/// seeds that give as large a one, anywhere: all of them up to 14 seeds, else 99,999 that are drawn, or fewer
/// once 20 were as large (Besag and Clifford, Biometrika 1991). A seed's series is flipped as a whole, so
/// that results which equal each other count as one. Two results give Wilcoxon's test or the sign test, by
/// what is clearer.
///
/// Of the places that are significant, the step is where the CUSUM is largest.
/// @param seeds one series a seed, of the same length of 2 or more, finite
/// @param level from which p on a place is significant
/// @return p in (0, 1], at least 2^(1 - n) where n seeds changed; p == 1 and place == 0 where none did.
/// Equal arguments give equal bytes
/// @throws std::invalid_argument when lengths differ or are below 2
ChangePoint find_change(std::span<const Series> seeds, double level);

/// All changes of level that are significant: the clearest one, then those of both parts, and so on.
///
/// Each part has half of the level of the whole, so that together they have no more than it.
/// @param level chance of a false one
/// @return by place; p is multiplied by 2 for each time that the series was parted before
/// @throws std::invalid_argument as find_change
std::vector<ChangePoint> find_changes(std::span<const Series> seeds, double level);

/// The fewest seeds of which a change can have a p-value below a level.
long fewest_seeds_for(double level);

}  // namespace stereobench::harness
