/// The rig that explains best what two cameras saw of a board.
#pragma once

#include <vector>

#include "harness/rig_calibration/types.h"

namespace stereobench::harness {

/// What is fitted, and to what.
struct RigFitSettings {
  Board board;
  int width_px = 0;  ///< of the pictures
  int height_px = 0;
  RigModel model = RigModel::kTwoCameras;
  FreeCoefficients lens = {true, true, true, true, false};
  bool square_pixels = true;  ///< or else each camera has a pixel aspect of its own
  bool robust = false;  ///< Cauchy's loss, so that corners that are far off do not count; no sd is worked out
};

/// Least squares over all corners in both cameras at once: the cameras, how the right one sits to the left
/// one, and where the board was in each view (bundle adjustment). It starts from each camera's own
/// calibration by Zhang's method (cv::calibrateCamera).
///
/// Standard deviations are those of least squares, s^2 (J' J)^-1, with s^2 the squares' sum over the degrees
/// of freedom.
/// @param views at least three
/// @throws std::runtime_error where the views do not determine a rig
RigFit fit_rig(const std::vector<BoardView>& views, const RigFitSettings& settings);

}  // namespace stereobench::harness
