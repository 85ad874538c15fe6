/// Balls put where a drive can see them.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "worlds/types.h"

namespace stereobench::worlds {

struct PlacementRules {
  std::uint64_t seed = 0;
  std::vector<Eigen::Vector2d> first_m;  ///< there must be balls here, seen or not
  int scattered = 0;                     ///< and so many anywhere on the field
  Eigen::AlignedBox2d field_m;
  int in_view = 2;       ///< at each step at least so many balls are in view, whatever a seed's jitter
  int most_balls = 100;  ///< at most 254
  double radius_m = 0.1;
  double clearance_m = 0.3;  ///< between the drive and a ball, beside the robot's own half width
  double wall_gap_m = 0.03;  ///< between a wall, or a mesh, and a ball
};

/// Puts balls into a scenario's world: those that are asked for, and more until in each step of its path
/// enough of them are in view.
///
/// Each stands on the floor, clear of walls, meshes, balls and the drive under any jitter, with a colour that
/// keeps the promises of `identity`, and does not hide others where they are needed.
/// @param scenario sensor, path, walls, meshes and identity are read, balls that are there stay
/// @throws std::invalid_argument naming the place or the first step for which none is left
void place_balls(Scenario& scenario, const PlacementRules& rules);

}  // namespace stereobench::worlds
