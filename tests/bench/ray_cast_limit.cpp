#include "tests/bench/ray_cast_limit.h"

#include <algorithm>
#include <array>

#include <immintrin.h>

namespace stereobench {
namespace {

using Floats = __m256;  // + - * / and comparisons are the compiler's
using Ints = std::int32_t __attribute__((vector_size(32)));
using Words = std::uint32_t __attribute__((vector_size(32)));

constexpr int kLanes = 8;
constexpr int kTileColumns = 64;
constexpr int kTileRows = 16;

Floats all(float value) {
  return _mm256_set1_ps(value);
}
Floats min(Floats a, Floats b) {
  return _mm256_min_ps(a, b);
}
Floats max(Floats a, Floats b) {
  return _mm256_max_ps(a, b);
}
Floats unit(Floats a) {
  return min(max(a, all(0.0F)), all(1.0F));
}
Floats absolute(Floats a) {
  return _mm256_andnot_ps(all(-0.0F), a);
}
Floats chosen(Ints mask, Floats yes, Floats no) {
  return _mm256_blendv_ps(no, yes, reinterpret_cast<Floats>(mask));
}
bool any(Ints mask) {
  return _mm256_movemask_ps(reinterpret_cast<Floats>(mask)) != 0;
}
Words whole(Floats a) {
  return reinterpret_cast<Words>(_mm256_cvttps_epi32(a));
}
const Floats kSteps = {0, 1, 2, 3, 4, 5, 6, 7};

struct Pair {
  Floats x, y;
};
struct Rgb {
  Floats r, g, b;
};

Floats random(Words key) {
  key ^= key >> 15;
  key *= 0x2c1b3c6dU;
  key ^= key >> 13;
  key *= 0x297a2d39U;
  return __builtin_convertvector(reinterpret_cast<Ints>(key), Floats) * (1.0F / 2147483648.0F);
}

Floats mix(Floats a, Floats b, Floats t) {
  return a + (b - a) * t;
}

[[gnu::always_inline]] inline Floats blend_cells(Pair cell, Pair weight) {
  const Words x = whole(cell.x) * 0x9e3779b1U, y = whole(cell.y) * 0x85ebca77U;
  const Words next_x = x + 0x9e3779b1U, next_y = y + 0x85ebca77U;
  return mix(mix(random(x ^ y), random(next_x ^ y), weight.x),
             mix(random(x ^ next_y), random(next_x ^ next_y), weight.x), weight.y);
}

// The three below are those of renderer/surfaces/material_shader.cpp, which says what they are.
[[gnu::always_inline]] inline Floats noise(Pair x, Pair footprint) {
  const Floats fade = unit(1.4F - 1.4F * max(footprint.x, footprint.y));
  if (!any(fade > 0.0F)) return all(0.0F);
  const Pair cell{_mm256_floor_ps(x.x), _mm256_floor_ps(x.y)};
  const Pair t{x.x - cell.x, x.y - cell.y};
  return fade * blend_cells(cell, {t.x * t.x * (3.0F - 2.0F * t.x), t.y * t.y * (3.0F - 2.0F * t.y)});
}

[[gnu::always_inline]] inline Floats patches(Pair x, Pair footprint, Pair per_footprint) {
  const Floats fade = unit(2.0F - max(footprint.x, footprint.y));
  if (!any(fade > 0.0F)) return all(0.0F);
  const Pair cell{_mm256_floor_ps(x.x - 0.5F * footprint.x), _mm256_floor_ps(x.y - 0.5F * footprint.y)};
  const Pair weight{unit((x.x + 0.5F * footprint.x - cell.x - 1.0F) * per_footprint.x),
                    unit((x.y + 0.5F * footprint.y - cell.y - 1.0F) * per_footprint.y)};
  return fade * blend_cells(cell, weight);
}

/// @return how many stripes, in parts of them, begin before a place
Floats stripes_up_to(Floats x, float width) {
  const Floats cell = _mm256_floor_ps(x);
  return cell * width + min(x - cell, all(width));
}

Floats stripes(Floats x, Floats footprint, Floats per_footprint, float width) {
  const Floats from = x - 0.5F * footprint, to = x + 0.5F * footprint;
  return unit((stripes_up_to(to, width) - stripes_up_to(from, width)) * per_footprint);
}

/// A place in cells of a pattern, and the pixel's extent there.
struct Cells {
  Cells(Pair place, Pair extent, float width, float height)
      : x{place.x * (1.0F / width), place.y * (1.0F / height)},
        footprint{extent.x * (1.0F / width), extent.y * (1.0F / height)},
        per_footprint{1.0F / footprint.x, 1.0F / footprint.y} {}

  Floats patches() const { return stereobench::patches(x, footprint, per_footprint); }
  Floats joints(float width_x, float width_y) const {
    return 1.0F - (1.0F - stripes(x.x, footprint.x, per_footprint.x, width_x)) *
                      (1.0F - stripes(x.y, footprint.y, per_footprint.y, width_y));
  }

  Pair x, footprint, per_footprint;
};

Rgb tiles(Pair place, Pair extent) {
  const Cells cells(place, extent, 0.30F, 0.30F);
  const Floats grain =
      noise({cells.x.x * 12.0F, cells.x.y * 12.0F}, {cells.footprint.x * 12.0F, cells.footprint.y * 12.0F});
  const Floats tone = 1.0F + 0.10F * cells.patches() + 0.07F * grain;
  const Floats t = cells.joints(0.025F, 0.025F);
  return {mix(0.62F * tone, all(0.36F), t), mix(0.60F * tone, all(0.35F), t),
          mix(0.56F * tone, all(0.34F), t)};
}

Rgb bricks(Pair place, Pair extent) {
  Cells cells(place, extent, 0.24F, 0.08F);
  cells.x.x += 0.5F * (_mm256_floor_ps(cells.x.y) - 2.0F * _mm256_floor_ps(0.5F * cells.x.y));
  const Floats grain = noise({place.x * 50.0F, place.y * 50.0F}, {extent.x * 50.0F, extent.y * 50.0F});
  const Floats tone = 1.0F + 0.16F * cells.patches() + 0.06F * grain;
  const Floats t = cells.joints(0.042F, 0.125F);
  return {mix(0.68F * tone, all(0.82F), t), mix(0.62F * tone, all(0.81F), t),
          mix(0.58F * tone, all(0.78F), t)};
}

/// A part of the picture that stays in the processor's nearest cache.
struct Tile {
  int first_column, first_row;
  std::array<float, std::size_t{kTileColumns} * kTileRows> red, green, blue, inverse_depth, id;
};

Floats at(const Linear& linear, Floats u, float v) {
  return (linear.at_zero + linear.per_row * v) + linear.per_column * u;
}

bool overlaps(const int (&columns)[2], const int (&rows)[2], const Tile& tile) {
  return columns[0] < tile.first_column + kTileColumns && columns[1] > tile.first_column &&
         rows[0] < tile.first_row + kTileRows && rows[1] > tile.first_row;
}

/// What of a surface eight pixels see, if it is nearer than what they saw.
void paint(const LimitSurface& surface, Tile& tile, std::size_t i, Floats u, float v) {
  const Floats inverse_depth = at(surface.inverse_depth, u, v);
  const Floats along = at(surface.along, u, v), up = at(surface.up, u, v);
  const Floats before = _mm256_loadu_ps(&tile.inverse_depth[i]);
  const Ints seen = (inverse_depth > before) & (along >= surface.along_m[0] * inverse_depth) &
                    (along <= surface.along_m[1] * inverse_depth) & (up >= surface.up_m[0] * inverse_depth) &
                    (up <= surface.up_m[1] * inverse_depth);
  if (!any(seen)) return;
  const Floats depth = 1.0F / inverse_depth;
  const Pair place{along * depth, up * depth};
  const auto extent = [&](const Linear& over_depth, Floats value) {  // of a pixel, by the quotient rule
    return max(depth * (absolute(over_depth.per_column - value * surface.inverse_depth.per_column) +
                        absolute(over_depth.per_row - value * surface.inverse_depth.per_row)),
               all(1e-5F));
  };
  const Pair footprint{extent(surface.along, place.x), extent(surface.up, place.y)};
  const Rgb rgb = surface.is_floor ? tiles(place, footprint) : bricks(place, footprint);
  const auto store = [&](float* to, Floats value) {
    _mm256_storeu_ps(to, chosen(seen, value, _mm256_loadu_ps(to)));
  };
  store(&tile.red[i], rgb.r * (255.0F * surface.light));
  store(&tile.green[i], rgb.g * (255.0F * surface.light));
  store(&tile.blue[i], rgb.b * (255.0F * surface.light));
  store(&tile.inverse_depth[i], inverse_depth);
}

void paint(const LimitSurface& surface, Tile& tile) {
  if (!overlaps(surface.columns_px, surface.rows_px, tile)) return;
  std::size_t i = 0;
  for (int row = 0; row < kTileRows; ++row)
    for (int column = 0; column < kTileColumns; column += kLanes, i += kLanes)
      paint(surface, tile, i, static_cast<float>(tile.first_column + column) + kSteps,
            static_cast<float>(tile.first_row + row));
}

/// The two below are those of renderer/balls/ball_shader.cpp.
Floats covered_area(Floats x, Floats y, Floats outside, Floats curvature) {
  const Floats a = max(x, y), b = max(min(x, y), all(1e-6F));
  const auto left_of = [&](Floats depth) { return max(0.5F * (a + b) - depth, all(0.0F)); };
  Floats corner = left_of(absolute(outside));
  const Ints cuts = corner < b;
  const Floats chord = chosen(cuts, corner / (a * b), 1.0F / a);
  const Floats middle = chosen(cuts, 0.5F * (a - b) * (1.0F - corner * (a + b) / (a * b)), b * outside / a);
  outside += 0.5F * curvature * (chord * chord / 12.0F + middle * middle);
  const Floats depth = absolute(outside);
  corner = left_of(depth);
  const Floats beyond = chosen(corner < b, 0.5F * corner * corner / (a * b), 0.5F - depth / a);
  return chosen(outside > 0.0F, beyond, 1.0F - beyond);
}

Floats coverage(const LimitBall& ball, Pair gradient, Floats level) {
  const Floats steepness = max(_mm256_sqrt_ps(gradient.x * gradient.x + gradient.y * gradient.y), all(1e-9F));
  const Floats x = gradient.x / steepness, y = gradient.y / steepness;
  const Floats curvature =
      level * (ball.shape[0] * y * y - 2.0F * ball.shape[1] * x * y + ball.shape[2] * x * x) / steepness;
  return covered_area(absolute(x), absolute(y), (level - 1.0F) * level / steepness, curvature);
}

void paint(const LimitBall& ball, const LimitLight& light, Tile& tile, std::size_t i, Pair q) {
  const Pair gradient{ball.shape[0] * q.x + ball.shape[1] * q.y, ball.shape[1] * q.x + ball.shape[2] * q.y};
  const Floats inside = 1.0F - (q.x * gradient.x + q.y * gradient.y);
  const Floats weight = coverage(ball, gradient, _mm256_sqrt_ps(1.0F - inside));
  const Floats root = _mm256_sqrt_ps(max(ball.shape[3] * inside, all(0.0F)));
  const Floats sight_x = ball.ray[0] + q.x * ball.ray[3], sight_y = ball.ray[1] + q.y * ball.ray[3];
  const Floats along = ball.ray[2] + ball.ray[3] * (q.x * ball.ball[0] + q.y * ball.ball[1]);
  const Floats distance = (along - root) / (sight_x * sight_x + sight_y * sight_y + 1.0F);
  const Floats inverse_depth = 1.0F / distance, before = _mm256_loadu_ps(&tile.inverse_depth[i]);
  const Ints seen = (inverse_depth > before) & ((inside > 0.0F) | (weight > 0.0F));
  if (!any(seen)) return;
  const Floats share = chosen(seen, weight, all(0.0F));
  const Floats facing = ((sight_x * distance - ball.ball[0]) * light.towards[0] +
                         (sight_y * distance - ball.ball[1]) * light.towards[1] +
                         (distance - ball.ball[2]) * light.towards[2]) *
                        ball.ball[3];
  const Floats lit = 255.0F * (light.ambient + light.diffuse * max(facing, all(0.0F)));
  const auto blend = [&](float* to, float colour) {
    _mm256_storeu_ps(to, mix(_mm256_loadu_ps(to), colour * lit, share));
  };
  blend(&tile.red[i], ball.rgb[0]);
  blend(&tile.green[i], ball.rgb[1]);
  blend(&tile.blue[i], ball.rgb[2]);
  const Ints core = seen & (inside > 0.0F);
  _mm256_storeu_ps(&tile.inverse_depth[i], chosen(core, inverse_depth, before));
  _mm256_storeu_ps(&tile.id[i], chosen(core, all(ball.id), _mm256_loadu_ps(&tile.id[i])));
}

void paint(const LimitBall& ball, const LimitLight& light, Tile& tile) {
  if (!overlaps(ball.columns_px, ball.rows_px, tile)) return;
  const int first_row = std::max(ball.rows_px[0] - tile.first_row, 0);
  const int end_row = std::min(ball.rows_px[1] - tile.first_row, kTileRows);
  const int first_column = std::max(ball.columns_px[0] - tile.first_column, 0) / kLanes * kLanes;
  const int end_column = std::min(ball.columns_px[1] - tile.first_column, kTileColumns);
  for (int row = first_row; row < end_row; ++row) {
    const float y = static_cast<float>(tile.first_row + row) - ball.centre_px[1];
    for (int column = first_column; column < end_column; column += kLanes)
      paint(ball, light, tile, static_cast<std::size_t>(row * kTileColumns + column),
            {static_cast<float>(tile.first_column + column) - ball.centre_px[0] + kSteps, all(y)});
  }
}

/// Four bytes each of eight pixels, those of the colours alone: 24 bytes.
void store_bgr(Ints pixels, std::uint8_t* to) {
  const __m256i order = _mm256_setr_epi8(0, 1, 2, 4, 5, 6, 8, 9, 10, 12, 13, 14, -1, -1, -1, -1,  //
                                         0, 1, 2, 4, 5, 6, 8, 9, 10, 12, 13, 14, -1, -1, -1, -1);
  const __m256i packed = _mm256_shuffle_epi8(reinterpret_cast<__m256i>(pixels), order);
  const __m128i last = _mm256_extracti128_si256(packed, 1);
  _mm_storeu_si128(reinterpret_cast<__m128i_u*>(to), _mm256_castsi256_si128(packed));  // 4 bytes of it again
  _mm_storeu_si64(to + 12, last);
  _mm_storeu_si32(to + 20, _mm_srli_si128(last, 8));
}

void store_bytes(Ints values, std::uint8_t* to) {
  const __m256i ints = reinterpret_cast<__m256i>(values);
  const __m128i words = _mm_packus_epi32(_mm256_castsi256_si128(ints), _mm256_extracti128_si256(ints, 1));
  _mm_storeu_si64(to, _mm_packus_epi16(words, words));
}

void write(const Tile& tile, const LimitPicture picture) {
  const auto levels = [](const float* from) {
    return reinterpret_cast<Ints>(_mm256_cvtps_epi32(min(_mm256_loadu_ps(from), all(255.0F))));
  };
  std::size_t i = 0;
  for (int row = 0; row < kTileRows; ++row) {
    std::size_t to =
        static_cast<std::size_t>(tile.first_row + row) * static_cast<std::size_t>(picture.width_px) +
        static_cast<std::size_t>(tile.first_column);
    for (int column = 0; column < kTileColumns; column += kLanes, i += kLanes, to += kLanes) {
      store_bgr(levels(&tile.blue[i]) | levels(&tile.green[i]) << 8 | levels(&tile.red[i]) << 16,
                picture.bgr + 3 * to);
      store_bytes(levels(&tile.id[i]), picture.id + to);
      _mm256_storeu_ps(picture.depth_m + to, 1.0F / _mm256_loadu_ps(&tile.inverse_depth[i]));
    }
  }
}

}  // namespace

bool can_cast_rays() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
}

void cast_rays(std::span<const LimitSurface> surfaces, std::span<const LimitBall> balls,
               const LimitLight& light, const LimitPicture& picture) {
  static Tile tile;
  for (tile.first_row = 0; tile.first_row < picture.height_px; tile.first_row += kTileRows) {
    for (tile.first_column = 0; tile.first_column < picture.width_px; tile.first_column += kTileColumns) {
      tile.blue.fill(light.sky_bgr[0]);
      tile.green.fill(light.sky_bgr[1]);
      tile.red.fill(light.sky_bgr[2]);
      tile.inverse_depth.fill(0.0F);
      tile.id.fill(0.0F);
      for (const LimitSurface& surface : surfaces) paint(surface, tile);
      for (const LimitBall& ball : balls) paint(ball, light, tile);
      write(tile, picture);
    }
  }
}

}  // namespace stereobench
