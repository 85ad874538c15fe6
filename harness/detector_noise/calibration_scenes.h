/// The calibration scenes that a detector's noise is measured in.
#pragma once

#include <cstdint>
#include <vector>

#include "harness/detector_noise/sample.h"
#include "renderer/types.h"
#include "worlds/generate/calibration_scene.h"

namespace stereobench::harness {

/// Looks around in one calibration scene a seed, with progress, in processes of their own.
/// @param experiment whose cameras and detector look
/// @param jobs processes at a time; the outcome does not depend on it
/// @return one take a seed, in their order
/// @throws as run_in_processes
std::vector<CalibrationTake> take_calibration_scenes(const Experiment& experiment,
                                                     const worlds::CalibrationSceneSettings& settings,
                                                     const std::vector<std::uint64_t>& seeds,
                                                     renderer::Backend backend, int jobs);

}  // namespace stereobench::harness
