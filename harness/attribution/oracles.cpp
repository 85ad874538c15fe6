#include "harness/attribution/oracles.h"

#include <fmt/format.h>

#include "harness/experiment/filter_config.h"
#include "worlds/scenario/scenario_parts.h"

namespace stereobench::harness {
namespace {

using worlds::Scenario;
using worlds::SensorKind;
using Lines = std::vector<std::string>;

/// A line for a key that is not zero already.
void make_zero(const std::string& key, double value, Lines& lines) {
  if (value != 0.0) lines.push_back(key + "=0");
}

/// A group of keys on one line.
template <class Keys, class Struct>
std::string line_of(const std::string& key, const Keys& keys, const Struct& value) {
  return key + "=" + YAML::Dump(keys.write(value));
}

Lines perfect_image(const Scenario& scenario) {
  Lines lines;
  make_zero("camera.noise_sd_levels", scenario.camera.noise_sd_levels, lines);
  make_zero("camera.read_noise_electrons", scenario.camera.read_noise_electrons, lines);
  make_zero("camera.full_well_electrons", scenario.camera.full_well_electrons, lines);
  return lines;
}

Lines perfect_timing(const Experiment& experiment) {
  const worlds::Shutter& shutter = experiment.scenario.shutter;
  Lines lines;
  make_zero("shutter.right_delay_s", shutter.right_delay_s, lines);
  make_zero("shutter.readout_s", shutter.readout_s, lines);
  make_zero("shutter.drop_probability", shutter.drop_probability, lines);
  make_zero("shutter.late_probability", shutter.late_probability, lines);
  if (experiment.detector_noise)
    make_zero("detector_noise.latency_frames", experiment.detector_noise->latency_frames, lines);
  return lines;
}

bool is_believed_right(const Scenario& scenario) {
  const vision::StereoRig& rig = scenario.rig;
  const vision::StereoRig& believed = scenario.believed_rig;
  const vision::Intrinsics& camera = rig.intrinsics;
  const vision::Intrinsics& told = believed.intrinsics;
  return camera.focal_px == told.focal_px && camera.cx_px == told.cx_px && camera.cy_px == told.cy_px &&
         rig.baseline_m == believed.baseline_m && rig.height_m == believed.height_m &&
         rig.pitch_down_rad == believed.pitch_down_rad && rig.right_turn_rad == believed.right_turn_rad &&
         rig.distortion == believed.distortion;
}

Lines perfect_rig(const Scenario& scenario) {
  if (is_believed_right(scenario)) return {};
  return {fmt::format("believed_rig={{rows_within_px: {}}}", scenario.rows_within_px)};
}

Lines perfect_places(const Experiment& experiment) {
  if (experiment.perfect_detections.places) return {};
  return {"perfect_detections.places=true"};
}

/// Numbers of the oracle are right unless a fault changes them.
bool are_names_right(const Experiment& experiment) {
  const auto& faults = experiment.detector_noise;
  const bool has_swaps = faults && (faults->identity_swap_probability > 0.0 || !faults->confusion.empty());
  return experiment.scenario.sensor == SensorKind::kOracle &&
         experiment.scenario.identity == worlds::Identity::kKnown && !has_swaps;
}

Lines perfect_names(const Experiment& experiment) {
  if (experiment.perfect_detections.names || are_names_right(experiment)) return {};
  return {"perfect_detections.names=true"};
}

slam::OdometryNoise scaled(slam::OdometryNoise noise, double factor) {
  for (double* const sd : {&noise.v_constant_mps, &noise.v_per_v, &noise.v_per_w, &noise.w_constant_radps,
                           &noise.w_per_v, &noise.w_per_w})
    *sd *= factor;
  return noise;
}

bool has_noise(const slam::OdometryNoise& noise) {
  return noise.v_constant_mps + noise.v_per_v + noise.v_per_w + noise.w_constant_radps + noise.w_per_v +
             noise.w_per_w >
         0.0;
}

Lines perfect_odometry(const Experiment& experiment) {
  const Scenario& scenario = experiment.scenario;
  if (!has_noise(scenario.odometry_noise) && start_covariance(scenario.start_noise).isZero(0.0)) return {};
  const FilterBeliefs& believed = experiment.believed;
  worlds::StartNoise start = scenario.start_noise;
  start.position_sd_m *= kPerfectNoise;
  start.heading_sd_rad *= kPerfectNoise;
  return {line_of("odometry_noise", worlds::odometry_noise_keys(),
                  scaled(scenario.odometry_noise, kPerfectNoise)),
          line_of("believed_odometry_noise", worlds::odometry_noise_keys(),
                  believed.odometry_noise.value_or(scenario.odometry_noise)),
          line_of("start_noise", worlds::start_noise_keys(), start),
          line_of("believed_start_noise", worlds::start_noise_keys(),
                  believed.start_noise.value_or(scenario.start_noise))};
}

}  // namespace

std::vector<Oracle> oracles_of(const Experiment& experiment) {
  const Scenario& scenario = experiment.scenario;
  std::vector<Oracle> oracles;
  const auto add = [&](const char* part, const char* says, const Lines& lines, bool is_noise = true) {
    if (!lines.empty()) oracles.push_back({part, says, lines, is_noise});
  };
  if (scenario.sensor == SensorKind::kStereo) {
    add("image_noise", "pixels have no noise", perfect_image(scenario));
    add("timing", "both cameras look when the frame says, and no frame is lost or late",
        perfect_timing(experiment), false);
    add("rig", "the rig is what vision takes it for", perfect_rig(scenario), false);
  }
  add("detection", "each ball that is seen is found, where it is", perfect_places(experiment));
  add("identities", "each detection has its ball's name", perfect_names(experiment), false);
  add("odometry", "odometry and start have a hundredth of their noise", perfect_odometry(experiment));
  return oracles;
}

}  // namespace stereobench::harness
