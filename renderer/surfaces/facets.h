/// Numbers for everything flat or round that a camera can see: whole surfaces, and the facets they are made
/// of.
///
/// A facet is what has one equation: a ball, the floor, a wall, a triangle of a mesh. A surface is what has
/// one name. They share their numbers up to the first mesh: 0 nothing, k = World::balls[k - 1] as in ball_id,
/// then the floor, then the walls. From there on facets go on triangle by triangle, surfaces mesh by mesh.
#pragma once

#include "worlds/types.h"

namespace stereobench::renderer {

inline constexpr int kNoFacet = 0;
inline constexpr int kFloorFacet = 255;
inline constexpr int kFirstWallFacet = 256;

/// The number of the first triangle of the first mesh, and of the first mesh.
inline int first_mesh_facet(const worlds::World& world) {
  return kFirstWallFacet + static_cast<int>(world.walls.size());
}

/// Whether a facet is round.
inline bool is_ball(int facet) {
  return facet > kNoFacet && facet < kFloorFacet;
}

}  // namespace stereobench::renderer
