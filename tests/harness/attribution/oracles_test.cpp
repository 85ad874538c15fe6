#include "harness/attribution/oracles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/experiment/experiment.h"
#include "harness/experiment/filter_config.h"
#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

using testing::ElementsAre;

Experiment experiment_of(const std::string& scenario, const std::vector<std::string>& overrides) {
  return read_experiment(scenario_path(scenario), overrides);
}

std::vector<std::string> parts_of(const std::string& scenario, const std::vector<std::string>& overrides) {
  std::vector<std::string> parts;
  for (const Oracle& oracle : oracles_of(experiment_of(scenario, overrides))) parts.push_back(oracle.part);
  return parts;
}

// Parts that are perfect already have no share, and cost no runs. Mutations: each condition.
TEST(Oracles, AreOfWhatIsNotPerfect) {
  EXPECT_THAT(parts_of("ball_circle", {"camera.noise_sd_levels=0"}),
              ElementsAre("detection", "identities", "odometry"));
  EXPECT_THAT(parts_of("ball_circle", {"camera.noise_sd_levels=2", "believed_rig={baseline_m: 0.13}",
                                       "shutter={right_delay_s: 0.01}"}),
              ElementsAre("image_noise", "timing", "rig", "detection", "identities", "odometry"));
  EXPECT_THAT(parts_of("ball_circle", {"camera.noise_sd_levels=0", "detector_noise={latency_frames: 1}"}),
              ElementsAre("timing", "detection", "identities", "odometry"));
  EXPECT_THAT(parts_of("open_field", {"identity=known"}), ElementsAre("detection", "odometry"));
  EXPECT_THAT(
      parts_of("open_field", {"identity=known", "odometry_noise={}", "perfect_detections={places: true}"}),
      ElementsAre());
  EXPECT_THAT(parts_of("open_field", {"identity=known", "detector_noise={identity_swap_probability: 0.1}"}),
              ElementsAre("detection", "identities", "odometry"));
}

/// The experiment with all parts perfect.
Experiment all_perfect(const std::string& scenario, std::vector<std::string> overrides) {
  for (const Oracle& oracle : oracles_of(experiment_of(scenario, overrides)))
    overrides.insert(overrides.end(), oracle.set.begin(), oracle.set.end());
  return experiment_of(scenario, overrides);
}

// Mutations: each line left out; noise that filters are not told.
TEST(Oracles, MakeEachPartPerfect) {
  const Experiment perfect = all_perfect(
      "ball_circle",
      {"camera={noise_sd_levels: 3, full_well_electrons: 9000, read_noise_electrons: 4}",
       "believed_rig={baseline_m: 0.13, rows_within_px: 7}",
       "shutter={right_delay_s: 0.01, readout_s: 0.02, drop_probability: 0.1, late_probability: 0.1, late_s: "
       "0.1, open_s: 0.01}",
       "detector_noise={latency_frames: 2, centre_sd_px: 1}",
       "odometry_noise={v_per_v: 0.5, correlation_s: 2}", "believed_odometry_noise={v_per_v: 3}",
       "start_noise={position_sd_m: 0.1, heading_sd_deg: 5}",
       "believed_measurement_noise={kind: constant, range_sd_m: 1, bearing_sd_deg: 1}"});
  const worlds::Scenario& scenario = perfect.scenario;
  EXPECT_EQ(scenario.camera.noise_sd_levels, 0.0);
  EXPECT_EQ(scenario.camera.full_well_electrons, 0.0);
  EXPECT_EQ(scenario.believed_rig.baseline_m, scenario.rig.baseline_m);
  EXPECT_EQ(scenario.rows_within_px, 7.0);
  EXPECT_EQ(scenario.shutter.right_delay_s, 0.0);
  EXPECT_EQ(scenario.shutter.readout_s, 0.0);
  EXPECT_EQ(scenario.shutter.drop_probability, 0.0);
  EXPECT_EQ(scenario.shutter.late_probability, 0.0);
  EXPECT_EQ(scenario.shutter.open_s, 0.01);
  EXPECT_EQ(perfect.detector_noise->latency_frames, 0);
  EXPECT_TRUE(perfect.perfect_detections.places && perfect.perfect_detections.names);
  EXPECT_NEAR(scenario.odometry_noise.v_per_v, 0.005, 1e-12);
  EXPECT_EQ(scenario.odometry_noise.correlation_s, 2.0);
  EXPECT_NEAR(perfect.believed.odometry_noise->v_per_v, 3.0, 1e-12);
  EXPECT_NEAR(scenario.start_noise.position_sd_m, 0.001, 1e-12);
  EXPECT_NEAR(perfect.believed.start_noise->position_sd_m, 0.1, 1e-12);
}

// Filters weigh all as they did before. Mutations: each belief left out.
TEST(Oracles, TellFiltersWhatTheyWereTold) {
  const std::vector<std::string> rates = {"oracle.miss_probability=0.1", "oracle.false_per_look=1",
                                          "start_noise={position_sd_m: 0.1}"};
  const slam::FilterConfig before = filter_config(experiment_of("open_field", rates));
  const slam::FilterConfig after = filter_config(all_perfect("open_field", rates));
  EXPECT_EQ(after.odometry_noise.v_per_v, before.odometry_noise.v_per_v);
  EXPECT_EQ(after.start_covariance, before.start_covariance);
  EXPECT_NEAR(after.sector.miss_probability, before.sector.miss_probability, 1e-12);
  EXPECT_NEAR(after.sector.false_per_look, before.sector.false_per_look, 1e-12);
  EXPECT_NEAR(after.sector.half_angle_rad, before.sector.half_angle_rad, 1e-9);
  EXPECT_FALSE(after.noise_law);
}

}  // namespace
}  // namespace stereobench::harness
