/// What an arc is worth, and which arcs are believed.
#pragma once

#include <array>
#include <cstddef>

namespace stereobench::vision {

/// The noise law first. Its constants are measured on rendered and painted balls so that NIS/2 is 1
/// (`stereobench calibrate`, tests/vision/noise_law_test.cpp). A pixel's alpha has the variance
/// k sigma^2 / A^2 + c^2; over a whole outline that makes sigma_u = sqrt(k sigma^2 / A^2 + c^2) / sqrt(pi r).
struct ArcFitTuning {
  /// c in focus: levels are whole numbers.
  double quantisation = 0.004;
  /// c out of focus: no camera's blur is just a Gaussian. Without it NIS/2 of rendered pictures is above 1.5.
  double profile = 0.008;
  /// c of a picture that was interpolated: no two edges look alike. Beyond the claim errors behind a lens
  /// were 0.036 / sqrt(r) px in a centre.
  double resampled = 0.042;
  /// k of a large ball: noise of the colours beside an arc adds to that of its pixels.
  double noise_factor = 1.06;
  /// k of a ball of one pixel's radius, less that: the smaller a ball, the fewer pixels tell its shading.
  double noise_factor_per_radius_px = 1.0;
  /// How often what k has beyond 1 counts for each pixel more of an edge (edge_width_px): it is an error of
  /// colours, which an arc's pixels share. Counted once, NIS/2 out of focus was up to 1.8.
  double noise_per_edge = 3.0;
  /// Variance of an arc, of its pixels' own texture variance: texture is shared by an arc's pixels, as far as
  /// it reaches.
  double texture_factor = 0.7;
  /// Length of bits of texture: longer arcs see more than one of what disturbs them, and their mean.
  double texture_length_px = 3.2;
  /// Least edge that an arc must show, px of it: taken along the ramp, or near balls are lost while they are
  /// searched with wide ramps.
  double least_edge_px = 0.25;

  /// Arcs contradict each other where their reduced chi-square is so many standard errors above 1.
  double contradiction_sigmas = 3.0;
  /// Most passes of weighing arcs and solving for the outline.
  int reweightings = 4;
  /// Residual from which on an arc's weight falls (Huber), in its standard deviations.
  double huber_sigmas = 2.0;
  /// Residual from which on an arc has no weight, times the former: an arc that is hidden must not
  /// pull the outline at all.
  double cut_off = 3.0;
  /// Least part of the outline that must speak for it: a fifth, free of occlusion, fixes centre and radius.
  double min_inlier_ratio = 0.2;
  /// Triples of arcs around the outline, of each distance below, of which the one that most arcs agree with
  /// tells which arcs are hidden. With least squares alone 8 of 120 slivers were lost.
  std::size_t triples = 24;
  /// From one arc of a triple to the next, parts of the outline: where a part is hidden, near ones are clear.
  std::array<std::size_t, 3> triple_parts = {12, 8, 5};
};
inline constexpr ArcFitTuning kArcFit{};

}  // namespace stereobench::vision
