#include "harness/experiment/stage_lines.h"

#include <gtest/gtest.h>

#include "harness/experiment/write_experiment.h"
#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

std::string scenario_with(const std::vector<std::string>& overrides) {
  return with_overrides(scenario_path("ball_circle"), overrides);
}

bool same_pictures(const std::vector<std::string>& overrides) {
  return lines_of_pictures(scenario_with(overrides)) == lines_of_pictures(scenario_with({}));
}

bool same_sight(const std::vector<std::string>& overrides) {
  return lines_of_sight(scenario_with(overrides)) == lines_of_sight(scenario_with({}));
}

// Mutations: each key left out of its list, or put into the other one.
TEST(StageLines, OfFiltersAreSeenByNoDetector) {
  for (const char* line : {"filters=[ekf]", "particles=7", "detector_noise={centre_sd_px: 1}",
                           "perfect_detections={names: true}", "odometry_noise.v_per_v=0.5",
                           "believed_odometry_noise={v_per_v: 0.5}", "start_noise={position_sd_m: 1}",
                           "seeds=4..9", "gates=[]", "believed_measurement_noise={kind: per_observation}"})
    EXPECT_TRUE(same_sight({line}) && same_pictures({line})) << line;
}

TEST(StageLines, OfDetectorsAreInNoPicture) {
  for (const char* line :
       {"detector='python3 other.py'", "detector_timeout_s=3", "believed_rig={baseline_m: 0.2}"})
    EXPECT_TRUE(!same_sight({line}) && same_pictures({line})) << line;
}

TEST(StageLines, OfWorldsAndCamerasAreInPictures) {
  for (const char* line : {"camera.noise_sd_levels=7", "path.laps=0.3", "shutter={open_s: 0.01}",
                           "rig.baseline_m=0.2", "identity=colour_class", "placement_jitter_m=0.2"})
    EXPECT_TRUE(!same_sight({line}) && !same_pictures({line})) << line;
}

}  // namespace
}  // namespace stereobench::harness
