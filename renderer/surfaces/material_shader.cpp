#include "renderer/surfaces/material_shader.h"

#include <stdexcept>

#include "renderer/textures/texture_shader.h"

namespace stereobench::renderer {
namespace {

constexpr const char* kVertex = R"glsl(#version 450 core
layout(location = 0) in vec4 a_position;
layout(location = 1) in vec2 a_along;
layout(location = 2) in float a_light;
layout(location = 3) in vec3 a_colour;
uniform mat4 u_clip_from_position;
uniform vec3 u_tint;  // factors on the material's colours: with the light, which costs no pixel anything
out vec2 v_along;
out vec3 v_light;
out vec3 v_colour;

void main() {
  gl_Position = u_clip_from_position * a_position;
  v_along = a_along;
  v_light = a_light * u_tint;
  v_colour = a_colour;
}
)glsl";

constexpr const char* kHead = R"glsl(#version 450 core
in vec2 v_along;
in vec3 v_light;
out vec4 o_colour;  // blue, green, red, identity

// A random value of a cell in [-1, 1]. key: the cell's coordinates times odd numbers, combined.
float random(uint key) {
  key ^= key >> 15;
  key *= 0x2c1b3c6du;
  key ^= key >> 13;
  key *= 0x297a2d39u;
  return float(int(key)) * (1.0 / 2147483648.0);
}

// Random values of the cells (0, 0), (1, 0), (0, 1), (1, 1) from a cell on, blended by the weights of column 1
// and row 1.
float blend_cells(vec2 cell, vec2 weight) {
  uvec2 low = uvec2(ivec2(cell)) * uvec2(0x9e3779b1u, 0x85ebca77u);
  uvec2 high = low + uvec2(0x9e3779b1u, 0x85ebca77u);
  vec2 rows = mix(vec2(random(low.x ^ low.y), random(low.x ^ high.y)),
                  vec2(random(high.x ^ low.y), random(high.x ^ high.y)), weight.x);
  return mix(rows.x, rows.y, weight.y);
}

// Smooth noise with one value per unit, which fades out as the footprint nears the size of its cells.
float noise(vec2 x, vec2 footprint) {
  vec2 cell = floor(x);
  vec2 t = x - cell;
  float fade = clamp(1.4 - 1.4 * max(footprint.x, footprint.y), 0.0, 1.0);
  return fade * blend_cells(cell, t * t * (3.0 - 2.0 * t));
}

// One random value per unit cell, averaged over the footprint: exact while it meets at most two cells a way.
float patches(vec2 x, vec2 footprint) {
  vec2 cell = floor(x - 0.5 * footprint);
  vec2 weight = clamp((x + 0.5 * footprint - cell - 1.0) / footprint, 0.0, 1.0);
  float fade = clamp(2.0 - max(footprint.x, footprint.y), 0.0, 1.0);
  return fade * blend_cells(cell, weight);
}

// The part of the footprint that lies in stripes of this width, one per unit, which begin at whole numbers.
vec2 stripes(vec2 x, vec2 footprint, vec2 width) {
  vec2 a = x - 0.5 * footprint, b = x + 0.5 * footprint;
  vec2 up_to_a = floor(a) * width + min(fract(a), width);
  vec2 up_to_b = floor(b) * width + min(fract(b), width);
  return clamp((up_to_b - up_to_a) / footprint, 0.0, 1.0);
}

// The same for a joint around each cell, along both ways.
float joints(vec2 x, vec2 footprint, vec2 width) {
  vec2 open = 1.0 - stripes(x, footprint, width);
  return 1.0 - open.x * open.y;
}

vec3 albedo(vec2 place, vec2 footprint);  // place on the material and the pixel's extent there, metres

void main() {
  vec2 footprint = max(abs(dFdx(v_along)) + abs(dFdy(v_along)), 1e-5);
  o_colour = vec4((albedo(v_along, footprint) * v_light).bgr, 0.0);
}
)glsl";

constexpr const char* kPlain = R"glsl(
vec3 albedo(vec2 place, vec2 footprint) { return vec3(0.72, 0.71, 0.69); }
)glsl";

constexpr const char* kTiles = R"glsl(
vec3 albedo(vec2 place, vec2 footprint) {
  vec2 x = place / 0.30, w = footprint / 0.30;
  float tone = 1.0 + 0.10 * patches(x, w) + 0.07 * noise(x * 12.0, w * 12.0);
  return mix(vec3(0.62, 0.60, 0.56) * tone, vec3(0.36, 0.35, 0.34), joints(x, w, vec2(0.025)));
}
)glsl";

constexpr const char* kPlaster = R"glsl(
// The octaves are turned against each other, or their grids would show.
vec3 albedo(vec2 place, vec2 footprint) {
  vec2 turned = vec2(0.80 * place.x + 0.60 * place.y, 0.80 * place.y - 0.60 * place.x);
  vec2 fine = vec2(0.28 * place.x - 0.96 * place.y, 0.28 * place.y + 0.96 * place.x);
  float width = max(footprint.x, footprint.y);
  float tone = 1.0 + 0.05 * noise(place / 0.55, vec2(width / 0.55)) + 0.045 * noise(turned / 0.09, vec2(width / 0.09))
               + 0.05 * noise(fine / 0.022, vec2(width / 0.022));
  return vec3(0.80, 0.78, 0.74) * tone;
}
)glsl";

constexpr const char* kBricks = R"glsl(
vec3 albedo(vec2 place, vec2 footprint) {
  vec2 x = place / vec2(0.24, 0.08), w = footprint / vec2(0.24, 0.08);
  x.x += 0.5 * (floor(x.y) - 2.0 * floor(0.5 * x.y));
  float tone = 1.0 + 0.16 * patches(x, w) + 0.06 * noise(place / 0.02, footprint / 0.02);
  return mix(vec3(0.68, 0.62, 0.58) * tone, vec3(0.82, 0.81, 0.78), joints(x, w, vec2(0.042, 0.125)));
}
)glsl";

constexpr const char* kWood = R"glsl(
vec3 albedo(vec2 place, vec2 footprint) {
  vec2 x = place / vec2(0.14, 2.4), w = footprint / vec2(0.14, 2.4);
  vec2 grain = vec2(110.0, 3.0);
  float tone = 1.0 + 0.10 * patches(x, w) + 0.12 * noise(place * grain, footprint * grain);
  return mix(vec3(0.68, 0.61, 0.53) * tone, vec3(0.36, 0.33, 0.29), joints(x, w, vec2(0.03, 0.002)));
}
)glsl";

constexpr const char* kPaint = R"glsl(
vec3 albedo(vec2 place, vec2 footprint) { return vec3(1.0); }
)glsl";

constexpr const char* kCorners = R"glsl(
in vec3 v_colour;
vec3 albedo(vec2 place, vec2 footprint) { return v_colour; }
)glsl";

std::string albedo_of(SurfacePaint paint) {
  switch (paint) {
    case SurfacePaint::kPlain:
      return kPlain;
    case SurfacePaint::kTiles:
      return kTiles;
    case SurfacePaint::kPlaster:
      return kPlaster;
    case SurfacePaint::kBricks:
      return kBricks;
    case SurfacePaint::kWood:
      return kWood;
    case SurfacePaint::kPaint:
      return kPaint;
    case SurfacePaint::kCorners:
      return kCorners;
    case SurfacePaint::kTexture:
      return texture_albedo();
  }
  throw std::invalid_argument("surface_fragment_shader: no such paint");
}

}  // namespace

std::string surface_vertex_shader() {
  return kVertex;
}

std::string surface_fragment_shader(SurfacePaint paint) {
  return kHead + albedo_of(paint);
}

}  // namespace stereobench::renderer
