/// Shapes on a lattice of squares: what floor plans are drawn along.
#pragma once

#include <utility>
#include <vector>

#include <Eigen/Core>

#include "slam/math/random.h"

namespace stereobench::worlds {

/// The corners of a random loop along the lattice's lines, counter-clockwise: the outline of squares that
/// hang together, have no hole and do not touch at a corner alone.
/// @param turns at least so many corners
/// @return empty when none is found
std::vector<Eigen::Vector2i> random_loop(int columns, int rows, int turns, slam::RandomStream& draws);

/// A pair of neighbouring cells.
using Passage = std::pair<Eigen::Vector2i, Eigen::Vector2i>;

/// A random tree over all cells, whose passages leave exactly one way between any two.
std::vector<Passage> random_tree(int columns, int rows, slam::RandomStream& draws);

/// The longest way through a tree of passages, cell by cell.
std::vector<Eigen::Vector2i> longest_way(int columns, int rows, const std::vector<Passage>& passages);

/// The points of a way without those at which it goes straight on.
std::vector<Eigen::Vector2i> corners_of(const std::vector<Eigen::Vector2i>& way, bool closed);

}  // namespace stereobench::worlds
