/// What passes for a shade of a ball, how its shading is fitted, and how balls share their light source.
#pragma once

#include <cstddef>

namespace stereobench::vision {

/// Which colours are shades of a ball's: those near the line from black through its colour.
struct ShadesTuning {
  /// Largest distance from that line, relative to brightness; pixels that mix the ball with what is behind
  /// it, and other colours, are further off.
  double tolerance = 0.10;
  /// The same for noise, in standard deviations.
  double noise_sigmas = 3.0;
  /// Least brightness, levels: a ball in the deepest shade and its own noise has more.
  double darkest_levels = 35.0;
};
inline constexpr ShadesTuning kShades{};

/// The fit of light from all around and one light source to a ball.
struct ShadingTuning {
  /// Samples for each px of radius: their noise is then small beside the rim's. With sixty or 120 errors of
  /// the nearest balls are a tenth larger (1.42 and 1.40 times the bound).
  double samples_per_radius_px = 200.0;
  /// Depth of the sampled ring, radii: it tells the rim's shade as well as all of the ball does, with two
  /// thirds of the instructions.
  double sampled_depth = 0.25;
  /// The same in px, at least: all of a small ball. With five pixels balls know their light source too
  /// little, and are measured once more.
  double sampled_depth_px = 8.0;
  /// Fewest samples for a shading, of three channels each: it has twelve unknowns.
  std::size_t fewest_samples = 24;
  /// Samples that tell about where the light source is, before all are asked: saves time on large balls.
  std::size_t first_samples = 100;
  /// Most turns of finding the lit side and fitting the light source.
  int most_turns = 12;
  /// Least evidence for a light source: chi-square with nine degrees of freedom and a lit side to choose. A
  /// ball seen from its unlit side outvoted others: one in four hundred was off by 5 to 15 times the bound.
  double by_chance = 40.0;
  /// Information on the light source, of a sample's, that is put in: one that nothing shows is none, and the
  /// equations have an inverse.
  double ridge = 1e-6;
};
inline constexpr ShadingTuning kShading{};

/// What balls tell each other of the light source: m = l / c0.
struct LightSourceTuning {
  /// A channel of no more than so many standard deviations of noise tells no ratio.
  double dark_sigmas = 3.0;
  /// Standard deviation of m between balls, at least: rounding, and light sources that are not so distant.
  /// With nothing here one ball is sure for all (lab book, balls seen from their unlit side).
  double least_scatter = 0.01;
  /// Standard deviation of m below which a ball needs no others: this keeps the price of measuring balls
  /// again at 2 to 13 % of the time.
  double well_known = 0.01;
  /// Samples of such a ball, at least.
  double many_samples = 200.0;
  /// Fewest balls that tell others of the light source: of one alone nothing says how alike they are.
  double fewest_balls = 2.0;
};
inline constexpr LightSourceTuning kLightSource{};

}  // namespace stereobench::vision
