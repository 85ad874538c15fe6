/// Which outlines of both cameras are one ball, and what makes it trusted.
#pragma once

namespace stereobench::vision {

struct MatchTuning {
  /// Standard deviations of noise within which outlines match: one in 16,000 is lost.
  double gate_sigmas = 4.0;
  /// Difference of rows beyond noise: the rig's and the fit's own errors.
  double row_gate_px = 0.35;
  /// Standard deviations of the balls' tolerance within which sizes match.
  double tolerance_sds = 3.0;
  /// Difference of radii beyond noise, and part of the radius: beyond both two outlines are not one ball.
  double size_gate_px = 0.45;
  double size_gate = 0.08;
  /// The same of a ball that is trusted: beyond it an outline is not that of a whole ball.
  double whole_size_gate_px = 0.2;
  double whole_size_gate = 0.025;

  /// Least part of an outline in each camera that speaks for a trusted ball: a third. Of 226 balls with a
  /// third of arc all but one would be within 5 mm at 3 m.
  double least_arc_share = 1.0 / 3.0;
  /// Largest reduced chi-square of a trusted outline: beyond it arcs are of two things. A limit of four,
  /// alone, lost 51 of the corridor's 9,700 observations.
  double most_reduced_chi_square = 6.0;
  /// Largest standard deviation of a disparity, px, of a trusted ball whose arcs contradict each other: one
  /// hidden ball of 1,040 was 56 mm off and claimed 9, no other claimed more than 0.026 px.
  double vague_px = 0.05;
};
inline constexpr MatchTuning kMatch{};

/// The ball that explains both outlines.
struct BallFitTuning {
  /// Standard deviation of a radius, of itself, before outlines are matched: size and disparity must be able
  /// to contradict each other.
  double loose_sd = 0.1;
  /// The same of a radius that is exactly known: as good as 0, and has an inverse.
  double exact_sd = 1e-7;
  /// Steps from where the centres triangulate to.
  int steps = 4;
  /// Steps from the loose fit.
  int further_steps = 2;
  /// Squared contradiction of size and disparity, in variances, beyond which either is taken to be off by as
  /// much: five standard deviations.
  double believed = 25.0;
};
inline constexpr BallFitTuning kBallFit{};

}  // namespace stereobench::vision
