/// Scenario files as everybody loads them: overrides put in place, and faults as the keys that they stand
/// for.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "worlds/yaml/yaml_document.h"

namespace stereobench::harness {

/// Loads a scenario file with its overrides. In place of `faults:` it has the keys that each severity stands
/// for, which replace those of the file; no stage behind knows of faults.
///
/// @throws std::runtime_error of one line as worlds::load_yaml; where there are faults, also for each unknown
///   or repeated key, for a severity that there is not, for a fault of cameras where the sensor has none, and
///   for a key that two faults, or a fault and an override, would set
worlds::YamlDocument load_scenario(const std::filesystem::path& file,
                                   const std::vector<std::string>& overrides);

/// Overrides that give the same scenario without naming a fault: each stands as the keys that it stands for.
/// @throws std::runtime_error as load_scenario
std::vector<std::string> without_fault_names(const std::filesystem::path& file,
                                             const std::vector<std::string>& overrides);

}  // namespace stereobench::harness
