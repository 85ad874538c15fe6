/// In which order variables are eliminated.
#pragma once

#include <span>
#include <vector>

namespace stereobench::slam {

/// Finds an order of elimination in which little fills in (CCOLAMD; Davis, Gilbert, Larimore and Ng, ACM TOMS
/// 2004).
///
/// @param ties sets of variables that a factor ties to each other; variables are counted from 0
/// @param is_late by variable: whether it is to come after all others
/// @return the variables in that order
std::vector<int> elimination_order(std::span<const std::vector<int>> ties, std::span<const int> is_late);

}  // namespace stereobench::slam
