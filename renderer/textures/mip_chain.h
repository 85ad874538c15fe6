/// Textures as the shader reads them: linear light, at every scale, filtered by us and not by a sampler,
/// whose arithmetic is another on each machine.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "renderer/textures/texture.h"

namespace stereobench::renderer {

inline constexpr int kMostLevels = 16;

/// Where a texture lies in the list of all texels.
struct MipPlace {
  std::array<int, 4> shape{};            ///< width, height, whether it repeats along each
  std::array<int, kMostLevels> first{};  ///< texel of each level
  int last_level = 0;                    ///< that of one texel
};

/// All levels of all textures.
struct MipChains {
  std::vector<std::uint32_t> texels;  ///< 11 bits of red, 11 of green, 10 of blue, from the lowest bit
  std::vector<MipPlace> places;       ///< of each texture
};

/// How many texels a texture has on all levels.
std::size_t mip_size(const Texture& texture);

/// Level k averages the light of blocks of 2^k x 2^k texels; the last of a row or column may be smaller.
/// @throws std::invalid_argument for a texture whose sides are not 1 to 32768
MipChains make_mip_chains(const std::vector<Texture>& textures);

}  // namespace stereobench::renderer
