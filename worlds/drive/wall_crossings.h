/// Where a drive goes through things that nobody can drive through.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "worlds/types.h"

namespace stereobench::worlds {

/// A line on the floor that something stands on, metres.
struct FloorSegment {
  Eigen::Vector2d from_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d to_m = Eigen::Vector2d::Zero();
};

/// A place where the drive crosses a line.
struct Crossing {
  std::size_t step = 0;  ///< of the path, on the way to which it happens
  Eigen::Vector2d at_m = Eigen::Vector2d::Zero();
};

/// The foot of each wall.
std::vector<FloorSegment> feet_of(const std::vector<Wall>& walls);

/// Follows the drive along its controls, arcs as chords of at most 5 degrees, and intersects it with lines.
/// Touching a line counts.
/// @return the crossings in the order of steps; each line once a step
std::vector<Crossing> crossings(const GroundTruth& path, std::span<const FloorSegment> lines);

}  // namespace stereobench::worlds
