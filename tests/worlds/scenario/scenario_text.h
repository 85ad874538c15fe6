/// Scenario files made up by tests: a small one that is right, and files that vanish with the test.
#pragma once

#include <cctype>
#include <stdexcept>
#include <string>

#include "tests/test_folder.h"

namespace stereobench::worlds {

/// A scenario with every group of keys. Line 1 is `name`.
inline const std::string kSmallScenario = R"(name: small
description: three balls
seeds: 0..2
particles: 20
filters: [dead_reckoning, ufastslam]
sensor: stereo
identity: known
rig: {width_px: 640, height_px: 480, focal_px: 500, baseline_m: 0.1, height_m: 0.3}
camera: {noise_sd_levels: 1}
oracle: {range_sd_m: 0.1, bearing_sd_deg: 1, max_range_m: 20, field_of_view_deg: 90}
odometry_noise: {v_per_v: 0.1, w_constant_degps: 2}
path:
  kind: circle
  radius_m: 1
  speed_mps: 0.5
  laps: 1
  step_s: 0.5
placement_jitter_m: 0.01
world:
  floor: bricks
  light: {towards_light: [0, 0, 1], ambient: 0.4}
  sky_rgb: [0, 0.5, 1]
  walls:
    - {corners_m: [[-4, -4], [4, -4], [4, 4]], closed: true, material: wood}
  meshes:
    - {file: thing.obj, at_m: [1, 2, 0], heading_deg: 90}
  ball_radius_m: 0.05
  balls:
    - {colour: 0, at_m: [2, 0, 0.1]}
    - {colour: 1, at_m: [0, 3, 0.1]}
    - {colour: 2, at_m: [-2, 0, 0.1]}
gates:
  - {metric: vision.recall, at_least: 0.9}
)";

/// A text as part of a test's name: letters, digits and few signs.
inline std::string plain(std::string text) {
  for (char& c : text)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '.') c = '_';
  return text;
}

/// A folder with the small scenario's mesh in it.
class ScenarioFolder : public TestFolder {
 public:
  ScenarioFolder() { write("thing.obj", "v 0 0 0\n"); }
};

/// The small scenario with one piece of its text put in place of another, which must be there.
inline std::string small_scenario_with(const std::string& piece, const std::string& instead) {
  std::string text = kSmallScenario;
  const std::size_t at = text.find(piece);
  if (at == std::string::npos) throw std::logic_error("the small scenario has no " + piece);
  return text.replace(at, piece.size(), instead);
}

/// The small scenario without floor and meshes, which a key may be set beside.
inline std::string bare_small_scenario() {
  std::string text = small_scenario_with("  floor: bricks\n", "");
  return text.erase(text.find("  meshes:"), text.find("  ball_radius_m") - text.find("  meshes:"));
}

}  // namespace stereobench::worlds
