/// Whether what is seen fits the map elsewhere too.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "slam/association/association.h"
#include "slam/association/joint_compatibility.h"

namespace stereobench::slam {

/// Looks for another set of pairs that explains half (rounded down) of the sightings of a set, and these not
/// much worse. A search that takes too long has found one.
///
/// Landmarks are taken to stand anywhere, each by itself. Each further pair of a set is then a coincidence
/// that hardly happens by chance. Where landmarks stand in even rows it happens always: a shift by one more
/// row pairs all that is seen, the right one perhaps less, since what the robot passes is not all in the map.
/// Sets are therefore compared by the sightings that both explain.
///
/// @param candidates those that are loose may be of several landmarks
/// @param set of pairs (by index) of the likeliest set
/// @param probability a set is compatible within this quantile of chi-square
/// @param unlikely by how much the cost of the other set may be higher: minus twice a log odds
bool fits_elsewhere(std::span<const Candidate> candidates, std::span<const Pairing> pairings, const Tie& tie,
                    const std::vector<std::size_t>& set, double probability, double unlikely);

}  // namespace stereobench::slam
