/// Which palette colour a pixel has, answered by one look-up.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>

#include <Eigen/Core>

namespace stereobench::vision {

inline constexpr std::uint8_t kBackground = 255;  ///< a pixel that has no ball's colour

/// Colours by BGR value, 6 bits a channel. Those of the palette: the nearest colour in rg chromaticity, which
/// shading leaves alone, if the pixel is bright, saturated and close enough to it.
class ColourTable {
 public:
  /// Computes all 64^3 entries from kPalette.
  ColourTable();

  /// The same from any other law. @param colour_of a BGR colour, levels of 255, or kBackground
  explicit ColourTable(const std::function<std::uint8_t(const Eigen::Vector3d&)>& colour_of);

  /// @return an index into the palette, or kBackground
  std::uint8_t classify(std::uint8_t b, std::uint8_t g, std::uint8_t r) const {
    const auto cell = (static_cast<std::size_t>(b >> 2) << 12) | (static_cast<std::size_t>(g >> 2) << 6) |
                      static_cast<std::size_t>(r >> 2);
    return cells_[cell];
  }

  /// The least difference between a colour's brightest and darkest channel, levels; what is greyer than that
  /// is background. 256 when everything is.
  int least_spread_levels() const { return least_spread_levels_; }

 private:
  std::array<std::uint8_t, 64 * 64 * 64> cells_;
  int least_spread_levels_ = 256;
};

/// The one table there is: it follows from kPalette alone, is built on first use and never changes.
const ColourTable& palette_table();

}  // namespace stereobench::vision
