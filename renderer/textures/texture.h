/// Pictures on the surfaces of meshes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace stereobench::renderer {

/// A picture as its file has it: sRGB, rows from the top. Texel (i, j) covers places [i, i + 1) x [j, j + 1).
struct Texture {
  int width_px = 0;
  int height_px = 0;
  std::array<bool, 2> repeats = {true, true};  ///< along rows, along columns; else its border goes on
  std::vector<std::uint8_t> rgb;               ///< 3 x width x height
};

}  // namespace stereobench::renderer
