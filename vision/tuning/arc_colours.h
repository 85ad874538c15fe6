/// What the colours beside an arc are taken for, and how well they are known.
#pragma once

#include <cstddef>

namespace stereobench::vision {

struct ArcColourTuning {
  /// Arcs to either side whose pixels tell how good the shading is: those of one arc tell little but noise.
  std::size_t shade_arcs = 3;
  /// Standard deviation of the ball's brightness at the rim while its shading is not known, relative to it:
  /// as measured two pixels further inside (lab book, shading of the rim).
  double unknown_shade = 0.12;
  /// The same where the shading suits all that is seen: its floor.
  double least_shade = 0.01;
  /// How many times as far off a shading is at the rim as beside it, where it is fitted.
  double shade_at_rim = 2.0;
  /// Scatter of the background below so many standard errors of the noise's is taken for noise.
  double texture_sigmas = 2.0;
  /// Arcs to either side whose colours tell an arc's texture: most often it goes on behind the rim.
  std::size_t texture_arcs = 1;
  /// Part of the texture beside all arcs that is added to an arc's own, as a variance: an edge may begin
  /// under the rim and be seen nowhere.
  double texture_elsewhere = 0.25;
  /// Arcs to either side whose colours tell a gradient in the background.
  std::size_t gradient_arcs = 3;
  /// Least evidence for a gradient: chi-square with three degrees of freedom, one in a hundred by chance.
  double gradient_by_chance = 11.3;
  /// What a gradient leaves must be noise to so many standard errors: a step in the background is texture,
  /// and a gradient through steps made errors of 1.75 times the bound.
  double smooth_sigmas = 3.0;
  /// Mean square of either colour's share in a rim pixel: it is 1/3 of shares that are
  /// spread evenly over [0, 1].
  double mean_square_share = 0.4;
  /// Least distance of the two colours, levels: nothing tells the ball from a background that is as like it.
  double min_contrast_levels = 14.0;
  /// Largest standard deviation of a pixel's share; a pixel that knows it no better than that says nothing.
  double max_alpha_sd = 0.5;
};
inline constexpr ArcColourTuning kArcColours{};

}  // namespace stereobench::vision
