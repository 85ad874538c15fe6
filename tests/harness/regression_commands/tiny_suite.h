/// A suite of small scenarios, for tests of `test` and `bless`.
#pragma once

#include <string>
#include <vector>

#include "tests/harness/commands/program.h"

namespace stereobench::harness {

inline const char* const kThreeBalls = R"(world:
  floor: plain
  ball_radius_m: 0.1
  balls:
    - {colour: 0, at_m: [2, 0, 0.1]}
    - {colour: 5, at_m: [2, 2, 0.1]}
    - {colour: 9, at_m: [-1, 2, 0.1]}
)";

/// Three balls around half a circle, sensed without pixels.
inline const char* const kTinyField = R"(
name: field
seeds: 0..9
filters: [iekf]
path: {kind: circle, radius_m: 1, speed_mps: 0.5, step_s: 0.5, laps: 0.5}
sensor: oracle
identity: known
oracle: {range_sd_m: 0.05, bearing_sd_deg: 1, max_range_m: 10, field_of_view_deg: 180}
odometry_noise: {v_constant_mps: 0.05, w_constant_degps: 1}
)";

/// The same balls, seen by a small camera.
inline const char* const kTinyRoom = R"(
name: room
seeds: 0..1
filters: [iekf]
path: {kind: circle, radius_m: 1, speed_mps: 0.5, step_s: 0.5, laps: 0.3}
sensor: stereo
identity: known
rig: {width_px: 320, height_px: 240, focal_px: 280, baseline_m: 0.12, height_m: 0.3}
camera: {noise_sd_levels: 2}
odometry_noise: {v_constant_mps: 0.05, w_constant_degps: 1}
)";

/// A folder with both scenarios and a suite.
class TinySuite {
 public:
  /// @param cases lines of YAML below `cases:`
  explicit TinySuite(const std::string& cases) {
    folder_.write("field.yaml", field());
    folder_.write("room.yaml", std::string(kTinyRoom) + kThreeBalls);
    folder_.write("tiny.yaml", "suite: tiny\ncases:\n" + cases);
  }

  /// The text of field.yaml.
  static std::string field() { return std::string(kTinyField) + kThreeBalls; }

  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  TestFolder& folder() { return folder_; }
  bool has(const std::string& name) const { return std::filesystem::exists(path(name)); }

  Outcome test(const std::vector<std::string>& more = {}) const {
    return run_stereobench(with({"test", path("tiny.yaml"), "--out", path("out"), "--jobs", "2"}, more));
  }
  Outcome bless(const std::vector<std::string>& more = {}) const {
    return run_stereobench(with({"bless", path("out"), "--reason", "because it is good"}, more));
  }

 private:
  TestFolder folder_;
};

}  // namespace stereobench::harness
