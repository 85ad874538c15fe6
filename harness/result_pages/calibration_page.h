/// The page of a detector's calibration.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "harness/detector_noise/calibration_result.h"
#include "harness/experiment/types.h"
#include "harness/page/page.h"

namespace stereobench::harness {

/// Gates, the table by depth, and errors and consistency over depth.
/// @param words of the command line, but for the seeds; empty: none is shown
Page calibration_page(const CalibrationResult& result, std::span<const Gate> gates,
                      std::span<const std::string> words);

}  // namespace stereobench::harness
