/// What makes a calibration a poor one.
#pragma once

#include <string>
#include <vector>

#include "harness/rig_calibration/rig_calibration.h"

namespace stereobench::harness {

/// What is wrong with a calibration and would repair it, a line each: corners that are farther off than
/// neighbours differ, so that something smooth is not in the model; few views; and views that leave the focal
/// length, or whether pixels are square, open.
/// @return empty for a good one
std::vector<std::string> warnings_of(const BoardCalibration& calibration, const BoardSettings& settings);

}  // namespace stereobench::harness
