/// Numbers for everything flat or round that a camera can see: whole surfaces, and the primitives they are
/// made of.
///
/// A primitive is what has one equation: a ball, the floor, a wall, a triangle of a mesh. A surface is what
/// has one name. They share their numbers up to the first mesh: 0 nothing, k = World::balls[k - 1] as in
/// ball_id, then the floor, then the walls. From there on primitives go on triangle by triangle, surfaces
/// mesh by mesh.
#pragma once

#include "worlds/types.h"

namespace stereobench::renderer {

inline constexpr int kNoPrimitive = 0;
inline constexpr int kFloorPrimitive = 255;
inline constexpr int kFirstWallPrimitive = 256;

/// The number of the first triangle of the first mesh, and of the first mesh.
inline int first_mesh_primitive(const worlds::World& world) {
  return kFirstWallPrimitive + static_cast<int>(world.walls.size());
}

/// Whether a primitive is round.
inline bool is_ball(int primitive) {
  return primitive > kNoPrimitive && primitive < kFloorPrimitive;
}

}  // namespace stereobench::renderer
