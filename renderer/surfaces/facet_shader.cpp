#include "renderer/surfaces/facet_shader.h"

namespace stereobench::renderer {

std::string facet_fragment_shader() {
  return R"glsl(#version 450 core
uniform ivec2 u_facet;  // of the first triangle; how much each further one adds
out vec4 o_bytes;

void main() {
  int facet = u_facet.x + u_facet.y * gl_PrimitiveID;
  o_bytes = vec4((ivec4(facet) >> ivec4(0, 8, 16, 24)) & 255) / 255.0;
}
)glsl";
}

}  // namespace stereobench::renderer
