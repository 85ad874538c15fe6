/// The colours that balls have: 18 points of the rg-chromaticity triangle, as far apart as they get.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <Eigen/Core>

namespace stereobench::vision {

/// A ball's colour under full light, linear, in levels of 255.
struct PaletteColour {
  std::uint8_t r = 0;
  std::uint8_t g = 0;
  std::uint8_t b = 0;
};

/// A ball's colour is an index into this list. Every colour has the same brightest channel, so that shading,
/// which scales all three channels, leaves only the chromaticity to tell colours apart.
inline constexpr std::array<PaletteColour, 18> kPalette = {{
    {229, 0, 0},
    {0, 229, 0},
    {0, 0, 229},
    {0, 229, 168},
    {229, 0, 168},
    {107, 229, 0},
    {229, 107, 0},
    {91, 0, 229},
    {0, 91, 229},
    {229, 229, 0},
    {229, 36, 22},
    {36, 229, 22},
    {229, 91, 137},
    {91, 229, 137},
    {68, 68, 229},
    {68, 154, 229},
    {154, 68, 229},
    {229, 165, 68},
}};

/// @param colour index into kPalette
/// @return (blue, green, red) in levels, as pictures have them
inline Eigen::Vector3d palette_bgr(int colour) {
  const PaletteColour& paint = kPalette[static_cast<std::size_t>(colour)];
  return {static_cast<double>(paint.b), static_cast<double>(paint.g), static_cast<double>(paint.r)};
}

}  // namespace stereobench::vision
