/// The S-curve: how the error of a centre goes with where it lies between the pixels.
#pragma once

namespace stereobench::vision::painter {

inline constexpr int kPhases = 16;       ///< evenly over a pixel
inline constexpr int kSCurveBalls = 18;  ///< one of each colour

/// What vision made of the balls of a phase, measured minus true.
struct PhaseErrors {
  double left_px = 0.0;  ///< of all colours' centres in the left camera, mean
  double disparity_px = 0.0;
  double radius_px = 0.0;  ///< largest of any
  int found = 0;           ///< of kSCurveBalls
};

/// Paints a ball of each colour without noise, all as far beside a column and a row of pixels, and looks.
/// @param phase in [0, kPhases)
/// @param radius_px of the outlines
PhaseErrors errors_at_phase(int phase, double radius_px);

}  // namespace stereobench::vision::painter
