/// Verdicts by steps: a few seeds first, and more where they do not decide.
#pragma once

#include <cstddef>
#include <vector>

#include "harness/regression/verdict.h"

namespace stereobench::harness {

/// How many seeds are looked at, look after look: 10, 20, 40 and so on.
/// @param most seeds that may be run, >= 1: the last look
std::vector<std::size_t> look_sizes(std::size_t most);

/// The chance of a false alarm that one look may have, so that all looks together have `alpha` at most
/// (Bonferroni).
double alpha_of_look(double alpha, std::size_t looks);

/// Whether more seeds can change nothing: a metric is REGRESSED or VANISHED, or none is INCONCLUSIVE.
bool is_decided(const ResultComparison& comparison);

}  // namespace stereobench::harness
