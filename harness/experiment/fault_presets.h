/// Named faults of detectors, cameras and rigs, each with five severities: what `faults:` of a scenario
/// stands for.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "worlds/yaml/key_group.h"

namespace stereobench::harness {

/// Severities are whole numbers: 0 changes nothing, 1 is barely harmful, this one is severe and still seen.
inline constexpr int kMostSeverity = 5;

/// What becomes of a level.
enum class LevelIs {
  kValue,          ///< the value of the key
  kFactorOnTruth,  ///< what is believed of the rig is so many times what it is
  kAddedToTruth,   ///< what is believed of the rig is so much more than it is
};

/// A key that a fault sets.
struct FaultSetting {
  std::string_view key;                                ///< group and key of the scenario
  std::array<std::string_view, kMostSeverity> levels;  ///< YAML, in the key's unit; severity 1 first
  LevelIs is = LevelIs::kValue;
};

/// A fault that has a name.
struct FaultPreset {
  std::string_view name;  ///< group and key below `faults:`
  std::string_view says;  ///< what is wrong, a sentence
  std::string_view why;   ///< where the levels are from, a sentence
  std::vector<FaultSetting> settings;
};

/// All of them.
std::span<const FaultPreset> fault_presets();

/// Whether it sets a key of the camera, the shutter or the rig, which an oracle does not have.
bool is_of_cameras(const FaultPreset& preset);

/// What the levels are of, for people: "camera.defocus_sd_px", or "believed_rig.focal_px / rig.focal_px".
std::string quantity_of(const FaultSetting& setting);

/// The keys below `faults:`, a group each for detector, camera and rig.
const worlds::KeyGroup& fault_keys();

}  // namespace stereobench::harness
