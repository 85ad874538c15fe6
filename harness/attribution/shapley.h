/// Whose an error is: what making parts of a chain perfect takes away, shared fairly among them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace stereobench::harness {

/// A set of parts that are perfect: bit i stands for part i.
using Coalition = std::size_t;

/// What a part is worth, one value a seed, in the unit of the error.
struct PartWorth {
  std::vector<double> share;         ///< Shapley's: the mean over all orders in which parts become perfect
  std::vector<double> only_perfect;  ///< what goes where this part alone is perfect
  std::vector<double> only_real;     ///< what stays where all but this part are perfect
};

/// Attributes an error to the parts of a chain (Shapley, in Contributions to the Theory of Games II, 1953):
/// share_i = sum over the sets S without i of |S|! (n - |S| - 1)! / n! (error(S) - error(S and i)).
///
/// For each seed the shares add up to error(none perfect) - error(all perfect), but for rounding.
/// @param errors one a coalition, in order of its bits, each with one value a seed; a seed with a NaN
///   anywhere has NaN in all of its shares
/// @return one a part
/// @throws std::invalid_argument unless there are 2^n coalitions with as many seeds each
std::vector<PartWorth> attribute(std::span<const std::vector<double>> errors);

}  // namespace stereobench::harness
