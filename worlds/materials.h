/// What surfaces are made of, and the shapes there are without a file.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace stereobench::worlds {

enum class Material {
  kPlain,
  kTiles,
  kPlaster,
  kBricks,
  kWood,
  kPaint,  ///< white: its tint is its colour
  kFile    ///< of meshes, the diffuse colours of their file; of walls and the floor, a picture
};

/// What materials are called, by Material; the last is for meshes alone: walls and the floor name a texture.
inline constexpr std::array<std::string_view, 7> kMaterialNames = {"plain", "tiles", "plaster", "bricks",
                                                                   "wood",  "paint", "file"};

/// A picture that a wall shows again and again, from where it begins, the right way round from either side;
/// or the floor, from the world's origin, with east to the right.
struct SurfaceTexture {
  std::string file;       ///< absolute after reading
  double tile_m = 1.0;    ///< width of the picture; its texels are square
  std::string stated_at;  ///< the line of the scenario that asks for it
};

/// What stands where no file says it: shapes of unit size, on the floor around their origin.
enum class MeshShape {
  kFile,
  kBox,  ///< a cube with sides of 1
  kBall  ///< of diameter 1, made of flat faces: no landmark, and in truth a surface like others
};

/// What shapes are called, by MeshShape, but for that of a file.
inline constexpr std::array<std::string_view, 2> kShapeNames = {"box", "ball"};

}  // namespace stereobench::worlds
