/// Where the fit of a rig begins.
#pragma once

#include <array>
#include <vector>

#include "harness/rig_calibration/rig_fit.h"

namespace stereobench::harness {

/// A pose as the fit has it: a rotation vector and a shift, metres.
using BoardPose = Eigen::Matrix<double, 6, 1>;

/// All that is fitted.
struct RigState {
  std::array<CameraParameters, 2> cameras;
  BoardPose left_from_right = BoardPose::Zero();
  std::vector<BoardPose> left_from_board;  ///< by view
};

/// Calibrates each camera by itself and puts the two together: where most views have the right one.
/// @throws std::runtime_error where a camera's views do not determine its parameters
RigState start_rig(const std::vector<BoardView>& views, const RigFitSettings& settings);

}  // namespace stereobench::harness
