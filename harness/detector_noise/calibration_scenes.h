/// The calibration scenes that a detector's noise is measured in.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "harness/detector_noise/sample.h"
#include "harness/store/answer_store.h"
#include "renderer/types.h"
#include "worlds/generate/calibration_scene.h"

namespace stereobench::harness {

/// Who looks at calibration scenes, and at which.
struct CalibrationLook {
  const Experiment& experiment;  ///< whose cameras and detector look
  worlds::CalibrationSceneSettings settings;
  renderer::Backend backend = renderer::Backend::kSoftware;
  std::vector<std::uint64_t> seeds;
};

/// Looks around in one calibration scene a seed, with progress, in processes of their own.
/// @param jobs processes at a time; the outcome does not depend on it
/// @return one take a seed, in their order
/// @throws as run_in_processes
std::vector<CalibrationTake> take_calibration_scenes(const CalibrationLook& look, int jobs);

/// The same for those that a store has no take of, which it keeps.
/// @param keys of the takes, one a seed: SHA-256 of all that they are made from
void take_into(AnswerStore& store, const CalibrationLook& look, const std::vector<std::string>& keys,
               int jobs);

}  // namespace stereobench::harness
