#include "renderer/surfaces/primitive_shader.h"

namespace stereobench::renderer {

std::string primitive_fragment_shader() {
  return R"glsl(#version 450 core
uniform ivec2 u_primitive;  // of the first triangle; how much each further one adds
out vec4 o_bytes;

void main() {
  int primitive = u_primitive.x + u_primitive.y * gl_PrimitiveID;
  o_bytes = vec4((ivec4(primitive) >> ivec4(0, 8, 16, 24)) & 255) / 255.0;
}
)glsl";
}

}  // namespace stereobench::renderer
