/// What a patch of colour must be to be looked at as a ball, and how often a blurred picture is measured.
#pragma once

namespace stereobench::vision {

struct DetectionTuning {
  /// Least area of a patch, of the smallest outline's: what hides a ball leaves less, and noise of that size
  /// is not worth a fit.
  double min_patch = 0.3;
  /// Least part of an outline's area that must be seen: what shows less of itself is not reported as a ball.
  double min_visible = 0.25;
  /// Largest distance between the centres of two outlines of one ball, in radii: pieces of a ball lead to one
  /// outline, and two balls whose centres are so near hide each other.
  double same_place = 0.5;
  /// A blur below this is the pixels' own: pictures in focus measure 0.12 +- 0.005 px (lab book, defocus).
  double in_focus_px = 0.2;
  /// Most measurements of one picture: each takes the blur that the one before has measured.
  int most_looks = 3;
  /// Relative change of the blur that ends these measurements: a blur is known to 0.01 px, of a px or so.
  double same_blur = 0.1;
  /// What the outline's fit looks at beyond it: a gap of 0.9 px and a ring of 2 px. A ball in a rectified
  /// picture is cut where that reaches beyond what was seen.
  double rim_px = 3.0;
};
inline constexpr DetectionTuning kDetection{};

}  // namespace stereobench::vision
