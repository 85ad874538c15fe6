#include "vision/colour/colour_table.h"

#include <algorithm>

#include "vision/palette.h"
#include "vision/tuning/colours.h"

namespace stereobench::vision {
namespace {

struct Chromaticity {
  double r = 0.0;
  double g = 0.0;
};

Chromaticity chromaticity(double r, double g, double b) {
  const double sum = r + g + b;
  return {r / sum, g / sum};
}

double squared_distance(Chromaticity a, Chromaticity b) {
  return (a.r - b.r) * (a.r - b.r) + (a.g - b.g) * (a.g - b.g);
}

std::uint8_t nearest_colour(double r, double g, double b) {
  const double brightest = std::max({r, g, b});
  const double darkest = std::min({r, g, b});
  if (brightest < kPaletteColours.min_brightness_levels ||
      brightest - darkest < kPaletteColours.min_saturation_levels)
    return kBackground;
  const Chromaticity pixel = chromaticity(r, g, b);
  if (squared_distance(pixel, {1.0 / 3.0, 1.0 / 3.0}) <
      kPaletteColours.min_white_distance * kPaletteColours.min_white_distance)
    return kBackground;

  std::uint8_t nearest = kBackground;
  double nearest_distance = kPaletteColours.max_chromaticity_error * kPaletteColours.max_chromaticity_error;
  for (std::size_t i = 0; i < kPalette.size(); ++i) {
    const double distance =
        squared_distance(pixel, chromaticity(kPalette[i].r, kPalette[i].g, kPalette[i].b));
    if (distance >= nearest_distance) continue;
    nearest = static_cast<std::uint8_t>(i);
    nearest_distance = distance;
  }
  return nearest;
}

// The value that stands for a cell of four levels; the darkest cell stands for black, since sensors clip
// there.
double cell_value(std::size_t index) {
  return index == 0 ? 0.0 : static_cast<double>(index) * 4.0 + 1.5;
}

}  // namespace

ColourTable::ColourTable()
    : ColourTable([](const Eigen::Vector3d& bgr) { return nearest_colour(bgr[2], bgr[1], bgr[0]); }) {}

ColourTable::ColourTable(const std::function<std::uint8_t(const Eigen::Vector3d&)>& colour_of) {
  for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
    const std::array<std::size_t, 3> bgr = {cell >> 12, (cell >> 6) & 63U, cell & 63U};
    cells_[cell] = colour_of(Eigen::Vector3d(cell_value(bgr[0]), cell_value(bgr[1]), cell_value(bgr[2])));
    if (cells_[cell] == kBackground) continue;
    const auto [darkest, brightest] = std::ranges::minmax(bgr);
    const int cells_apart = static_cast<int>(brightest - darkest);
    least_spread_levels_ = std::min(least_spread_levels_, std::max(0, 4 * cells_apart - 3));
  }
}

const ColourTable& palette_table() {
  static const ColourTable table;
  return table;
}

}  // namespace stereobench::vision
