#include "renderer/textures/mip_chain.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/Core>

#include "slam/math/elementary.h"

namespace stereobench::renderer {
namespace {

constexpr int kLongest_px = 1 << (kMostLevels - 1);

/// Sums of light over blocks, so that each level is the average of texels and not of averages.
struct Level {
  int width = 0;
  int height = 0;
  std::vector<Eigen::Vector4f> sums;  ///< red, green, blue, and how many texels

  Eigen::Vector4f& at(int column, int row) { return sums[index(column, row)]; }
  const Eigen::Vector4f& at(int column, int row) const { return sums[index(column, row)]; }
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
  }
};

/// Light of an 8-bit level (IEC 61966-2-1).
std::array<float, 256> light_of_levels() {
  std::array<float, 256> light{};
  for (std::size_t i = 0; i < light.size(); ++i) {
    const double level = static_cast<double>(i) / 255.0;
    light[i] =
        static_cast<float>(level <= 0.04045 ? level / 12.92 : slam::power((level + 0.055) / 1.055, 2.4));
  }
  return light;
}

/// A texture's own texels, which are not copied.
struct Finest {
  const Texture& picture;
  int width = picture.width_px;
  int height = picture.height_px;

  Eigen::Vector4f at(int column, int row) const {
    static const std::array<float, 256> light = light_of_levels();
    const std::uint8_t* rgb =
        &picture.rgb[3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                          static_cast<std::size_t>(column))];
    return {light[rgb[0]], light[rgb[1]], light[rgb[2]], 1.0F};
  }
};

template <typename FinerLevel>
Level halved(const FinerLevel& finer) {
  Level level{(finer.width + 1) / 2, (finer.height + 1) / 2, {}};
  level.sums.assign(static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.height),
                    Eigen::Vector4f::Zero());
  for (int row = 0; row < finer.height; ++row)
    for (int column = 0; column < finer.width; ++column)
      level.at(column / 2, row / 2) += finer.at(column, row);
  return level;
}

std::uint32_t texel_of(const Eigen::Vector4f& sum) {
  const auto part = [&](int channel, float most) {
    return static_cast<std::uint32_t>(std::lround(sum[channel] / sum[3] * most));
  };
  return part(0, 2047.0F) | part(1, 2047.0F) << 11U | part(2, 1023.0F) << 22U;
}

template <typename AnyLevel>
void append(const AnyLevel& level, MipChains& made) {
  for (int row = 0; row < level.height; ++row)
    for (int column = 0; column < level.width; ++column)
      made.texels.push_back(texel_of(level.at(column, row)));
}

void check(const Texture& texture) {
  const int shorter = std::min(texture.width_px, texture.height_px);
  const int longer = std::max(texture.width_px, texture.height_px);
  if (shorter < 1 || longer > kLongest_px)
    throw std::invalid_argument("make_pyramids: a texture has sides of 1 to 32768 texels");
}

}  // namespace

std::size_t mip_size(const Texture& texture) {
  std::size_t size = 0;
  int width = texture.width_px, height = texture.height_px;
  for (;; width = (width + 1) / 2, height = (height + 1) / 2) {
    size += static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    if (width == 1 && height == 1) return size;
  }
}

MipChains make_mip_chains(const std::vector<Texture>& textures) {
  MipChains made;
  for (const Texture& texture : textures) {
    check(texture);
    MipPlace place{.shape = {texture.width_px, texture.height_px, texture.repeats[0] ? 1 : 0,
                             texture.repeats[1] ? 1 : 0}};
    place.first[0] = static_cast<int>(made.texels.size());
    append(Finest{texture}, made);
    Level level = halved(Finest{texture});
    while (made.texels.size() - static_cast<std::size_t>(place.first[0]) < mip_size(texture)) {
      place.first[static_cast<std::size_t>(++place.last_level)] = static_cast<int>(made.texels.size());
      append(level, made);
      level = halved(level);
    }
    made.places.push_back(place);
  }
  return made;
}

}  // namespace stereobench::renderer
