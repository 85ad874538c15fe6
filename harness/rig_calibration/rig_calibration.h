/// From the pictures of a board to a rig: what was used, what was not and why, and how good the result is.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/io/calibration_file.h"
#include "harness/rig_calibration/board_files.h"
#include "harness/rig_calibration/model_choice.h"

namespace stereobench::harness {

/// What became of a pair of pictures.
struct ViewOutcome {
  std::string name;
  std::string dropped;        ///< why it was not used; empty when it was
  std::size_t index = 0;      ///< into the fit's views, of those that were
  double row_rms_px = 0.0;    ///< between the cameras, once rectified
  double row_worst_px = 0.0;  ///< the largest of them
};

/// A calibration, and how well it explains what was seen.
struct BoardCalibration {
  RigCalibration rig;
  RigFit fit;
  std::vector<ModelTrial> models;     ///< that were compared; the fit is of the one that was taken
  std::vector<BoardView> used;        ///< the views of the fit
  std::vector<ViewOutcome> outcomes;  ///< one a pair of pictures
  double row_rms_px = 0.0;            ///< over all corners, once rectified
  double row_mean_px = 0.0;           ///< of sizes
  double square_mean_m = 0.0;         ///< sides of squares as the rig measures them, corner to corner
  double square_rms_m = 0.0;          ///< of their errors
};

/// What is asked for.
struct BoardSettings {
  Board board;
  RigModel model = RigModel::kTwoCameras;
  FreeCoefficients lens = {true, true, true, true, false};
  bool square_pixels = true;  ///< where the aspect is not compared
  Compared compared;          ///< what is left to the views to decide
  std::size_t fewest_views = 3;
};

/// Finds the board in all pictures, drops the views that do not suit the others (those whose error is more
/// than three times the median of all, after a fit of the fullest model in which corners that are far off do
/// not count), and takes the simplest model that the rest does not reject (choose_model).
/// @throws std::runtime_error, one line, for a picture that cannot be read, where too few views are left
/// (which says what became of the others), and where they do not determine a rig
BoardCalibration calibrate_rig(const std::vector<ViewFiles>& files, const BoardSettings& settings);

}  // namespace stereobench::harness
