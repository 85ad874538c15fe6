/// The calibration.yaml of `stereobench render`, with all that it says twice.
#pragma once

#include <string>

#include "harness/verify/dataset_view.h"

namespace stereobench::harness {

/// Reads both cameras, with their places on the robot. What the file says twice and differently is a fault: K
/// and D against P1 and P2, baseline_m against the cameras' places.
/// @param file its place in the folder
/// @throws std::runtime_error as read_calibration
std::array<ViewCamera, 2> read_rig_cameras(DatasetView& view, const std::string& file);

}  // namespace stereobench::harness
