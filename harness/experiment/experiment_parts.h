/// The parts of a scenario file that say what is run, each read from its group of keys.
#pragma once

#include <optional>

#include "harness/experiment/types.h"
#include "worlds/yaml/fields.h"

namespace stereobench::harness {

/// `believed_measurement_noise:` what the filters are told of sightings.
struct MeasurementNoise {
  std::optional<slam::NoiseLaw> law;  ///< none: each sighting is taken at its word, to scale
  Eigen::Vector2d stated_sd_scale = Eigen::Vector2d::Ones();  ///< of range, bearing
};

/// @param rig where there is one: the stereo law is about its focal length and baseline
MeasurementNoise read_measurement_noise(const worlds::YamlValue& value,
                                        const std::optional<vision::StereoRig>& rig);

/// `detector_noise:` what is made worse of a detector's answers.
/// @param scenario whose sensor and identity are read already
DetectorFaults read_detector_faults(const worlds::YamlValue& value, const worlds::Scenario& scenario);

/// The keys of each group, and the members that they fill.
const worlds::KeyGroup& measurement_noise_keys();
const worlds::Fields<slam::SensorSector>& believed_oracle_keys();
const worlds::Fields<Gate>& gate_keys();
const worlds::Fields<DetectorFaults>& detector_faults_keys();

}  // namespace stereobench::harness
