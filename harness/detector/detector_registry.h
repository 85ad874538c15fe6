/// Detectors by name: what `--detector NAME` and a scenario's `detector: NAME` choose before any program.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "harness/detector/detector.h"

namespace stereobench::harness {

/// A detector that is linked in. Ours is called `stereobench`.
struct DetectorKind {
  std::string name;
  std::function<Detector(const DetectorSetup&)> make;  ///< called once a drive
};

/// Adds a detector. Call it before run_program (harness/program.h); a name is taken once.
/// @throws std::invalid_argument for a name that is empty or taken
void register_detector(DetectorKind kind);

/// @return null where no linked detector has this name
const DetectorKind* find_detector(std::string_view name);

}  // namespace stereobench::harness
