/// What surfaces are made of, and the shapes there are without a file.
#pragma once

namespace stereobench::worlds {

enum class Material {
  kPlain,
  kTiles,
  kPlaster,
  kBricks,
  kWood,
  kPaint,  ///< white: its tint is its colour
  kFile    ///< of meshes alone: the diffuse colours of their file
};

/// What stands where no file says it: shapes of unit size, on the floor around their origin.
enum class MeshShape {
  kFile,
  kBox,  ///< a cube with sides of 1
  kBall  ///< of diameter 1, made of flat faces: no landmark, and in truth a surface like others
};

}  // namespace stereobench::worlds
