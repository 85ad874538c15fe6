/// What is said of a calibration by a board.
#pragma once

#include <string>

#include "harness/rig_calibration/rig_calibration.h"

namespace stereobench::harness {

/// For people: each view and each parameter with its standard deviation.
std::string calibration_text(const BoardCalibration& calibration, const BoardSettings& settings);

/// The same for programs, as JSON.
std::string calibration_json(const BoardCalibration& calibration, const BoardSettings& settings);

}  // namespace stereobench::harness
