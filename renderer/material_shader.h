/// The GLSL programs that draw surfaces: patterns computed per pixel and averaged over the pixel's footprint.
#pragma once

#include <string>

#include "worlds/types.h"

namespace stereobench::renderer {

std::string surface_vertex_shader();

/// One program per material: a rasteriser that works on eight pixels at once runs every branch of an `if`.
/// All materials are grey or beige, so that none is taken for a ball's colour, but for those of mesh files.
std::string surface_fragment_shader(worlds::Material material);

}  // namespace stereobench::renderer
