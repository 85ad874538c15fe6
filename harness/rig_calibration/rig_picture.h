/// A calibration to look at.
#pragma once

#include <string>

#include "harness/rig_calibration/rig_calibration.h"

namespace stereobench::harness {

/// Draws a pair rectified, with lines that go through both cameras' rows and the corners of
/// the board, and below it each view's errors.
/// @param pair CV_8UC3, as taken
/// @param view which of the fit's views it is
/// @return the bytes of a PNG file
std::string draw_rig_picture(const BoardCalibration& calibration, std::size_t view,
                             const vision::StereoPair& pair);

}  // namespace stereobench::harness
