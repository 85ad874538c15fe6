/// Pictures on walls and on the floor.
#pragma once

#include <array>
#include <vector>

#include "renderer/surfaces/mesh_surfaces.h"

namespace stereobench::renderer {

/// How a wall or the floor shows a texture.
struct PolygonTexture {
  int index = -1;  ///< into the world's textures; none
  float texels_per_m = 0.0F;
  float height_px = 0.0F;

  /// A corner's place on the texture, whose rows begin at its top.
  /// @param along_m along and up the surface
  /// @param runs_left as the camera sees it: the picture is the right way round from either side
  std::array<float, 2> texel(const float (&along_m)[2], bool runs_left) const {
    return {(runs_left ? -texels_per_m : texels_per_m) * along_m[0], height_px - texels_per_m * along_m[1]};
  }
};

/// What a world's files hold, in its place.
struct Surfaces {
  MeshSurfaces meshes;  ///< and the textures of all surfaces, those of polygons last
  std::vector<PolygonTexture>
      polygons;  ///< in the order of primitives (primitives.h): the floor, and each wall
};

/// Reads meshes and the textures of walls and of the floor, each file once.
/// @throws std::runtime_error as place_meshes, or, one line, where the scenario names a texture and what is
/// wrong with it
Surfaces place_surfaces(const worlds::World& world, const FormReader& read = read_form);

}  // namespace stereobench::renderer
