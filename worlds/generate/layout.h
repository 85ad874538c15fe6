/// Floor plans that are made: walls, and a tour through them.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "worlds/types.h"

namespace stereobench::worlds {

/// A lattice of squares, one `pitch_m` apart, with corridors along its lines or cells between them.
struct LatticeConfig {
  std::uint64_t seed = 0;
  int columns = 3;
  int rows = 3;
  double pitch_m = 6.0;
  double width_m = 2.4;  ///< of corridors
  int turns = 4;         ///< of the tour, at least
  int doors = 0;         ///< panels of wood on the walls of a corridor loop
  double height_m = 2.6;
};

struct Layout {
  std::vector<Wall> walls;
  std::vector<Eigen::Vector2d> tour_m;  ///< corners of the drive, in the middle of corridors
  bool closed = false;                  ///< the tour ends where it began
  double corner_radius_m = 0.0;         ///< that keeps its distance from walls around corners, too
};

/// One corridor around a random shape of squares: walls on both sides, doors drawn on them.
/// @throws std::invalid_argument when corridors would overlap, or no shape has so many turns
Layout make_corridor_loop(const LatticeConfig& config);

/// Square blocks of rooms with corridors between and around them; the tour is a random loop.
/// @throws std::invalid_argument as above
Layout make_office_grid(const LatticeConfig& config);

/// Square cells in which one way leads from any to any; the tour is the longest there is.
/// @throws std::invalid_argument when there are fewer than two cells
Layout make_maze(const LatticeConfig& config);

}  // namespace stereobench::worlds
