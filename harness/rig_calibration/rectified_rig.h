/// A fitted rig as the vision stage takes it.
#pragma once

#include <optional>

#include "harness/io/calibration_file.h"
#include "harness/rig_calibration/types.h"

namespace stereobench::harness {

/// How the cameras of a fitted rig have to be turned to look straight ahead, with their rows along the
/// baseline. Of one camera twice, the left one looks where it looked; of two cameras both are turned, by half
/// of what is between them each, and then together (J.-Y. Bouguet's rectification).
/// @throws std::runtime_error where the cameras are not side by side, the right one on the right, or where a
/// lens that is known near the middle only folds the corners
RigCalibration rectified_rig(const RigFit& fit, RigModel model, int width_px, int height_px);

/// Where a corner would be in a camera's rectified picture.
/// @return empty where the lens folds its picture
std::optional<Eigen::Vector2d> rectified_px(const RigCalibration& rig, const Eigen::Vector2d& taken_px,
                                            vision::Side side);

}  // namespace stereobench::harness
