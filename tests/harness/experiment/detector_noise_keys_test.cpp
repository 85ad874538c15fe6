// `detector_noise:` of a scenario: what it says, and what it cannot say.
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/experiment/experiment.h"
#include "tests/complaint.h"
#include "tests/worlds/scenario/faults.h"
#include "tests/worlds/scenario/scenario_text.h"

namespace stereobench::harness {
namespace {

using testing::ElementsAre;
using testing::StartsWith;
using worlds::BadOverride;
using worlds::ScenarioFolder;

std::string complaint_about_noise(const std::filesystem::path& file,
                                  const std::vector<std::string>& overrides = {}) {
  return complaint_of([&] { read_experiment(file, overrides); });
}

// Mutations: a member that another key fills; a group that is there where no line names it.
TEST(DetectorNoise, SaysWhatIsMadeWorse) {
  const ScenarioFolder folder;
  const auto file = folder.write("good.yaml", worlds::kSmallScenario);
  EXPECT_FALSE(read_experiment(file).detector_noise);
  const DetectorFaults faults =
      *read_experiment(file,
                       {"detector_noise={centre_sd_px: 0.5, centre_bias_px: [[1, 2], [3, 4]], heavy_tail: "
                        "{share: 0.1, sd_scale: 5}, correlated_s: 2, quantise_px: 0.25, range_scale: 1.1, "
                        "miss_probability: 0.1, miss_by_visible: [[0.2, 1], [0.8, 0]], miss_by_range: [[2, "
                        "0], [9, 0.5]], miss_burst_frames: 3, false_per_frame: 0.3, false_within_m: 7, "
                        "identity_swap_probability: 0.2, confusion: [[0.9, 0.1], [0, 1]], latency_frames: 4, "
                        "covariance: as_stated, covariance_scale: 2}"})
           .detector_noise;
  EXPECT_EQ(faults.centre_sd_px, 0.5);
  EXPECT_THAT(faults.centre_bias_px, ElementsAre(Eigen::Vector2d(1, 2), Eigen::Vector2d(3, 4)));
  EXPECT_EQ(faults.heavy_tail, (HeavyTail{0.1, 5.0}));
  EXPECT_EQ(faults.correlated_s, 2.0);
  EXPECT_EQ(faults.quantise_px, 0.25);
  EXPECT_EQ(faults.range_scale, 1.1);
  EXPECT_EQ(faults.miss_probability, 0.1);
  EXPECT_THAT(faults.miss_by_visible, ElementsAre(Eigen::Vector2d(0.2, 1), Eigen::Vector2d(0.8, 0)));
  EXPECT_THAT(faults.miss_by_range, ElementsAre(Eigen::Vector2d(2, 0), Eigen::Vector2d(9, 0.5)));
  EXPECT_EQ(faults.miss_burst_frames, 3);
  EXPECT_EQ(faults.false_per_frame, 0.3);
  EXPECT_EQ(faults.false_within_m, 7.0);
  EXPECT_EQ(faults.identity_swap_probability, 0.2);
  EXPECT_THAT(faults.confusion, ElementsAre(ElementsAre(0.9, 0.1), ElementsAre(0.0, 1.0)));
  EXPECT_EQ(faults.latency_frames, 4);
  EXPECT_EQ(faults.covariance, StatedCovariance::kAsStated);
  EXPECT_EQ(faults.covariance_scale, 2.0);
}

class BadDetectorNoise : public testing::TestWithParam<BadOverride> {};

// Mutations: each check dropped.
TEST_P(BadDetectorNoise, IsRefusedInALine) {
  worlds::expect_blamed(GetParam(), complaint_about_noise);
}
constexpr BadOverride kBad[] = {
    {"detector_noise.centre_sd_px=-1",
     "--set detector_noise.centre_sd_px: expected a number from 0 to 1000 (got -1)"},
    {"detector_noise.centre_sd=1", "--set detector_noise.centre_sd: unknown key"},
    {"detector_noise.centre_bias_px=[1, 2]", "--set detector_noise.centre_bias_px[0]: expected a list of 2"},
    {"detector_noise.heavy_tail={share: 0.1}",
     "--set detector_noise.heavy_tail.sd_scale: this key is missing"},
    {"detector_noise.miss_probability=1.1",
     "--set detector_noise.miss_probability: expected a number from 0 to 1 (got 1.1)"},
    {"detector_noise.miss_by_range=[[1, 0.5], [1, 0.6]]",
     "--set detector_noise.miss_by_range[1][0]: expected a number above 1 (got 1)"},
    {"detector_noise.miss_by_range=[[1, 1.5]]",
     "--set detector_noise.miss_by_range[0][1]: expected a probability from 0 to 1 (got 1.5)"},
    {"detector_noise.miss_by_visible=[[1, 0.5], [0.5, 0.6]]",
     "--set detector_noise.miss_by_visible[1][0]: expected a number above 1 (got 0.5)"},
    {"detector_noise.confusion=[[0.9, 0.1], [0.5, 0.6]]",
     "--set detector_noise.confusion[1]: expected probabilities that sum to 1 (got a sum of 1.1)"},
    {"detector_noise.confusion=[[0.9, 0.1]]",
     "--set detector_noise.confusion[0]: expected a list of 1, as there are rows (got a list of 2)"},
    {"detector_noise.covariance=true",
     "--set detector_noise.covariance: expected one of honest, as_stated (got true)"},
};
INSTANTIATE_TEST_SUITE_P(All, BadDetectorNoise, testing::ValuesIn(kBad));

// Mutations: a key left out of either list; colours confused that the oracle does not see.
TEST(DetectorNoise, IsRefusedWhereThereIsNothingThatItCouldBeOf) {
  const ScenarioFolder folder;
  const auto file = folder.write("small.yaml", worlds::kSmallScenario);
  for (const std::string line : {"centre_sd_px=1", "centre_bias_px=[[0,0],[0,0]]", "quantise_px=1",
                                 "heavy_tail={share: 0, sd_scale: 1}", "correlated_s=1",
                                 "miss_by_visible=[[0,0]]", "false_within_m=5", "covariance=honest"})
    EXPECT_THAT(complaint_about_noise(file, {"sensor=oracle", "detector_noise." + line}),
                StartsWith("--set detector_noise." + line.substr(0, line.find('=')) +
                           ": the oracle has no pixels; oracle.range_sd_m,"));
  for (const std::string line : {"identity_swap_probability=0.1", "confusion=[[1]]"})
    EXPECT_THAT(complaint_about_noise(file, {"identity=none", "detector_noise." + line}),
                StartsWith("--set detector_noise." + line.substr(0, line.find('=')) +
                           ": identity is none: detections have no name"));
  EXPECT_THAT(complaint_about_noise(file, {"sensor=oracle", "detector_noise.confusion=[[1]]"}),
              StartsWith("--set detector_noise.confusion: expected identity: colour_class"));
  EXPECT_NO_THROW(
      read_experiment(file, {"sensor=oracle",
                             "detector_noise={miss_probability: 0.1, miss_by_range: [[1, 0.1]], "
                             "miss_burst_frames: 2, false_per_frame: 1, identity_swap_probability: 0.1, "
                             "latency_frames: 1, range_scale: 1.1, covariance_scale: 2}"}));
}

// Mutation: the line of the group in place of the row's.
TEST(DetectorNoise, IsBlamedOnTheLineOfTheFile) {
  const ScenarioFolder folder;
  const auto file = folder.write(
      "bad.yaml",
      worlds::small_scenario_with(
          "particles: 20", "detector_noise:\n  confusion:\n    - [1, 0]\n    - [0.2, 0.7]\nparticles: 20"));
  EXPECT_THAT(
      complaint_about_noise(file),
      StartsWith(file.string() + ":7: detector_noise.confusion[1]: expected probabilities that sum to 1"));
}

}  // namespace
}  // namespace stereobench::harness
