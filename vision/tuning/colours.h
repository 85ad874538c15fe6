/// Which pixels have a ball's colour.
#pragma once

#include <cstddef>

namespace stereobench::vision {

/// Of the palette that our own balls have.
struct PaletteTuning {
  /// Least brightest channel, levels: a palette colour in deep shade has 103.
  double min_brightness_levels = 60.0;
  /// Least difference of brightest and darkest channel, levels: five standard deviations of the worst noise.
  double min_saturation_levels = 40.0;
  /// Largest distance of chromaticity from the nearest palette colour: neighbours are 0.11 apart.
  double max_chromaticity_error = 0.11;
  /// Least distance of chromaticity from white: the palest palette colour has 0.16.
  double min_white_distance = 0.085;
};
inline constexpr PaletteTuning kPaletteColours{};

/// Of colours that were learned from samples.
struct LearnedColourTuning {
  /// Fewest pixels of a sample, half of which have to tell a mean and a covariance.
  std::size_t fewest_pixels = 20;
  /// Standard deviation that is added to a colour's own scatter of chromaticity: cells of the table have four
  /// levels, and other places other lights.
  double floor = 0.012;
  /// Distance of chromaticity from grey of what has a colour.
  double least_saturation = 0.06;
  /// Least brightest channel, levels: darker pixels say nothing of their colour.
  double least_level = 20.0;
  /// Least brightest channel of a colour, of its darkest sample's: other places are darker.
  double darker = 0.6;
  /// Part of a colour's samples that may be darker than "the darkest": their rims.
  double darkest_share = 0.02;
  /// Least distance from grey, of the colour's own: highlights and haze are greyer than the paint.
  double from_grey = 0.5;
  /// Most steps that look for the half of the samples that lies closest together.
  int concentrations = 20;
  /// Standard deviations from a colour within which a pixel has it: chi-square(2) at 99.9 %.
  double gate_sds = 3.717;
};
inline constexpr LearnedColourTuning kLearnedColours{};

}  // namespace stereobench::vision
