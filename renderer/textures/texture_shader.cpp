#include "renderer/textures/texture_shader.h"

namespace stereobench::renderer {

namespace {

constexpr const char* kAlbedo = R"glsl(
in vec3 v_colour;
uniform usamplerBuffer u_texels;
uniform int u_shape[4];   // width, height, whether it repeats along each
uniform int u_first[16];  // texel of each level
uniform int u_last_level;

vec3 light_of(int texel) {
  uint parts = texelFetch(u_texels, texel).r;
  return vec3(parts & 2047u, (parts >> 11) & 2047u, parts >> 22) * vec3(1.0 / 2047.0, 1.0 / 2047.0, 1.0 / 1023.0);
}

// The cell before, or behind, the border: at the other end, or the border's own.
ivec2 wrapped(ivec2 cell, ivec2 size, bvec2 repeats) {
  ivec2 before = mix(ivec2(0), size - 1, repeats);
  ivec2 behind = mix(size - 1, ivec2(0), repeats);
  return mix(mix(cell, before, lessThan(cell, ivec2(0))), behind, greaterThanEqual(cell, size));
}

// Bilinear; place: in texels of the finest level, within the texture.
vec3 level_colour(vec2 place, int level, ivec2 whole, bvec2 repeats) {
  ivec2 size = (whole + (1 << level) - 1) >> level;
  vec2 x = place * intBitsToFloat((127 - level) << 23) - 0.5;  // times 2^-level
  vec2 cell = floor(x);
  vec2 t = x - cell;
  ivec2 low = wrapped(ivec2(cell), size, repeats);
  ivec2 high = wrapped(ivec2(cell) + 1, size, repeats);
  int row = u_first[level] + low.y * size.x, next = u_first[level] + high.y * size.x;
  return mix(mix(light_of(row + low.x), light_of(row + high.x), t.x),
             mix(light_of(next + low.x), light_of(next + high.x), t.x), t.y);
}

vec3 albedo(vec2 place, vec2 footprint) {
  vec2 right = dFdx(place), down = dFdy(place);
  float width = clamp(sqrt(max(dot(right, right), dot(down, down))), 1.0, intBitsToFloat((127 + u_last_level) << 23));
  int bits = floatBitsToInt(width);
  int level = (bits >> 23) - 127;
  float t = intBitsToFloat((bits & 0x7fffff) | 0x3f800000) - 1.0;  // how far to the next level
  ivec2 whole = ivec2(u_shape[0], u_shape[1]);
  bvec2 repeats = bvec2(u_shape[2], u_shape[3]);
  vec2 size = vec2(whole);
  vec2 inside = mix(clamp(place, vec2(0.0), size), place - size * floor(place / size), repeats);
  return v_colour * mix(level_colour(inside, level, whole, repeats),
                        level_colour(inside, min(level + 1, u_last_level), whole, repeats), t);
}
)glsl";

}  // namespace

std::string texture_albedo() {
  return kAlbedo;
}

}  // namespace stereobench::renderer
