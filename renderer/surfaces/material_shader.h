/// The GLSL programs that draw surfaces: patterns computed per pixel and averaged over the pixel's footprint.
#pragma once

#include <string>

namespace stereobench::renderer {

/// What a surface shows: that of a material, or of a mesh file.
enum class SurfacePaint {
  kPlain,  ///< those of materials are in Material's order
  kTiles,
  kPlaster,
  kBricks,
  kWood,
  kPaint,
  kCorners,  ///< colours between those of the corners
  kTexture   ///< a picture, times those colours (texture_shader.h)
};

std::string surface_vertex_shader();

/// One program per paint: a rasteriser that works on eight pixels at once runs every branch of an `if`.
/// All materials are grey or beige, so that none is taken for a ball's colour; tints may make them so.
std::string surface_fragment_shader(SurfacePaint paint);

}  // namespace stereobench::renderer
