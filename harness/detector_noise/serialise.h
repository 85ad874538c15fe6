/// What a calibration scene gave, on its way from a worker process to its parent, exact to the last bit.
#pragma once

#include <string>
#include <string_view>

#include "harness/detector_noise/sample.h"

namespace stereobench::harness {

/// What a calibration scene gave as bytes (CBOR), and back.
std::string to_bytes(const CalibrationTake& take);
CalibrationTake calibration_take_from_bytes(std::string_view bytes);

}  // namespace stereobench::harness
