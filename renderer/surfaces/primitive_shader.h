/// The GLSL program that writes which primitive a pixel's centre sees; that of balls is in ball_shader.h.
#pragma once

#include <string>

namespace stereobench::renderer {

/// Goes with surface_vertex_shader(). Writes a number's four bytes, the lowest first: u_primitive.x, plus the
/// number of the triangle within the draw call where u_primitive.y is 1.
std::string primitive_fragment_shader();

}  // namespace stereobench::renderer
