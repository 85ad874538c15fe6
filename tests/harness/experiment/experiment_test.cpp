// An experiment says what its file says of who looks, what is run, and what filters are told.
#include "harness/experiment/experiment.h"

#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/experiment/filter_config.h"
#include "tests/worlds/scenario/scenario_text.h"
#include "worlds/drive/path.h"

namespace stereobench::harness {
namespace {

using testing::ElementsAre;

Experiment read_small(const std::vector<std::string>& overrides = {}) {
  const worlds::ScenarioFolder folder;
  return read_experiment(folder.write("good.yaml", worlds::kSmallScenario), overrides);
}

TEST(Experiment, SaysWhatIsRun) {
  const Experiment experiment = read_small();
  EXPECT_EQ(experiment.scenario.name, "small");
  EXPECT_THAT(experiment.seeds, ElementsAre(0, 1, 2));
  EXPECT_THAT(experiment.filters, ElementsAre("dead_reckoning", "ufastslam"));
  EXPECT_EQ(experiment.particles, 20);
  EXPECT_EQ(experiment.gates.at(0).metric, "vision.recall");
  EXPECT_EQ(experiment.gates.at(0).relation, Gate::Relation::kAtLeast);
  EXPECT_EQ(experiment.gates.at(0).limit, 0.9);
  EXPECT_EQ(experiment.scenario.world.balls.size(), 3U);
  EXPECT_GT(experiment.scenario.path.size(), 1U);
}

// Mutation: the list of names in another order than what they name.
TEST(Experiment, SaysHowSightingsAreAssociated) {
  EXPECT_EQ(read_small().association, slam::Association::kJoint);
  EXPECT_EQ(read_small({"association=individual"}).association, slam::Association::kIndividual);
}

// Mutation: the two times in each other's place.
TEST(Experiment, SaysWhoLooksAndForHowLong) {
  EXPECT_EQ(read_small().detector.command, "");
  const DetectorProgram detector =
      read_small({"detector=./mine", "detector_timeout_s=2", "detector_start_s=3"}).detector;
  EXPECT_EQ(detector.command, "./mine");
  EXPECT_EQ(detector.timeout_s, 2.0);
  EXPECT_EQ(detector.start_s, 3.0);
}

TEST(Experiment, OverridesReplaceWhatTheFileSaysAndAddWhatItLeavesOut) {
  const Experiment experiment =
      read_small({"path.laps=2", "camera.noise_sd_levels=4", "particles=7", "seeds=3,5", "filters[1]=ekf",
                  "believed_odometry_noise.v_per_v=0.5", "particles=8"});
  EXPECT_NEAR(worlds::length_m(experiment.scenario.path), 4 * std::numbers::pi, 1e-12);
  EXPECT_EQ(experiment.scenario.camera.noise_sd_levels, 4.0);
  EXPECT_EQ(experiment.particles, 8) << "the last one counts";
  EXPECT_THAT(experiment.seeds, ElementsAre(3, 5));
  EXPECT_THAT(experiment.filters, ElementsAre("dead_reckoning", "ekf"));
  EXPECT_EQ(experiment.scenario.odometry_noise.v_per_v, 0.1);
  const slam::OdometryNoise told = filter_config(experiment).odometry_noise;
  EXPECT_EQ(told.v_per_v, 0.5);
  EXPECT_EQ(told.w_constant_radps, 0.0) << "a group of its own";
}

// Catches: a belief that stays at the file's noise when the true noise is overridden.
TEST(Experiment, BelievesTheTrueNoiseUnlessToldOtherwise) {
  const Experiment experiment = read_small({"odometry_noise.v_per_v=0.02"});
  EXPECT_FALSE(experiment.believed.odometry_noise);
  const slam::OdometryNoise told = filter_config(experiment).odometry_noise;
  EXPECT_EQ(told.v_per_v, 0.02);
  EXPECT_EQ(told.w_constant_radps, experiment.scenario.odometry_noise.w_constant_radps);
}

// What filters are told of an oracle's sector and rates is a line of its own. Catches: the truth told in any
// case, and what is left out taken for 0.
TEST(Experiment, BelievesTheTrueOracleUnlessToldOtherwise) {
  const std::vector<std::string> oracle = {
      "sensor=oracle",
      "oracle={range_sd_m: 0.1, bearing_sd_deg: 1, max_range_m: 8, field_of_view_deg: 90, "
      "miss_probability: 0.1, false_per_look: 2}"};
  EXPECT_FALSE(read_small(oracle).believed.sector);
  std::vector<std::string> lines = oracle;
  lines.emplace_back("believed_oracle.false_per_look=0.5");
  const slam::SensorSector rarer = read_small(lines).believed.sector.value();
  EXPECT_EQ(rarer.false_per_look, 0.5);
  EXPECT_EQ(rarer.range_m, 8.0);
  EXPECT_EQ(rarer.half_angle_rad, std::numbers::pi / 4.0);
  EXPECT_EQ(rarer.miss_probability, 0.1);
  lines.back() = "believed_oracle={max_range_m: 0, field_of_view_deg: 60, miss_probability: 0.3}";
  const slam::SensorSector none = read_small(lines).believed.sector.value();
  EXPECT_EQ(none.range_m, 0.0) << "nothing is declared";
  EXPECT_NEAR(none.half_angle_rad, std::numbers::pi / 6.0, 1e-15);
  EXPECT_EQ(none.miss_probability, 0.3);
  EXPECT_EQ(none.false_per_look, 2.0);
  EXPECT_EQ(read_small(lines).scenario.oracle.false_per_look, 2.0) << "the sensor stays as it is";
}

// 500 px and 0.1 m. Catches: pixels that are taken for metres, and a law that is told to nobody's rig.
TEST(Experiment, ReadsTheNoiseThatFiltersBelieveOfTheSensor) {
  EXPECT_FALSE(read_small().believed.measurement_noise);
  EXPECT_FALSE(read_small({"believed_measurement_noise={kind: per_observation}"}).believed.measurement_noise);
  const auto constant =
      read_small({"believed_measurement_noise={kind: constant, range_sd_m: 0.3, bearing_sd_deg: 3}"})
          .believed.measurement_noise.value();
  EXPECT_EQ(constant.range_sd_m, 0.3);
  EXPECT_EQ(constant.range_sd_per_m2, 0.0);
  EXPECT_NEAR(constant.bearing_sd_rad, 0.0523598775598299, 1e-15);
  const auto stereo =
      read_small({"believed_measurement_noise={kind: stereo, disparity_sd_px: 0.2, bearing_sd_px: 0.1}"})
          .believed.measurement_noise.value();
  EXPECT_EQ(stereo.range_sd_m, 0.0);
  EXPECT_NEAR(stereo.range_sd_per_m2, 0.004, 1e-15);
  EXPECT_NEAR(stereo.bearing_sd_rad, 0.0002, 1e-15);
}

TEST(Experiment, ReadsByHowMuchStatedNoiseIsTooSmall) {
  EXPECT_EQ(read_small().believed.stated_sd_scale, Eigen::Vector2d::Ones());
  const Experiment experiment = read_small(
      {"believed_measurement_noise={kind: per_observation, range_sd_scale: 1.5, bearing_sd_scale: 0.9}"});
  EXPECT_FALSE(experiment.believed.measurement_noise);
  EXPECT_EQ(experiment.believed.stated_sd_scale, Eigen::Vector2d(1.5, 0.9));
}

TEST(Experiment, ShippedOnesHaveTheSeedsThatTheyPromise) {
  const auto seeds_of = [](const std::string& name) {
    return read_experiment(fmt::format("{}/assets/scenarios/{}.yaml", STEREOBENCH_SOURCE_DIR, name))
        .seeds.size();
  };
  EXPECT_EQ(seeds_of("ball_circle"), 10U);
  EXPECT_EQ(seeds_of("corridor"), 5U);
  EXPECT_EQ(seeds_of("open_field"), 100U);
}

}  // namespace
}  // namespace stereobench::harness
