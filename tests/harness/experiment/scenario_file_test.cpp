// `faults:` of a scenario beside its other keys: what is replaced, what is refused, and who is to blame.
#include "harness/experiment/scenario_file.h"

#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/experiment/experiment.h"
#include "harness/experiment/write_experiment.h"
#include "slam/math/angles.h"
#include "tests/complaint.h"
#include "tests/worlds/scenario/faults.h"
#include "tests/worlds/scenario/scenario_text.h"

namespace stereobench::harness {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using worlds::BadOverride;
using worlds::kSmallScenario;
using worlds::ScenarioFolder;
using worlds::small_scenario_with;

std::string complaint_about_faults(const std::filesystem::path& file,
                                   const std::vector<std::string>& overrides = {}) {
  return complaint_of([&] { read_experiment(file, overrides); });
}

// The file has noise of one level. Mutations: the file's value kept; the group replaced whole.
TEST(Faults, ReplaceWhatTheFileSays) {
  const ScenarioFolder folder;
  const auto file = folder.write(
      "small.yaml", small_scenario_with("{noise_sd_levels: 1}", "{noise_sd_levels: 1, vignette: 0.3}"));
  const Experiment worse = read_experiment(file, {"faults.camera.noise=2"});
  EXPECT_EQ(worse.scenario.camera.noise_sd_levels, 8.0);
  EXPECT_EQ(worse.scenario.camera.vignette, 0.3);
  EXPECT_EQ(read_experiment(file, {"faults.camera.noise=0"}).scenario.camera.noise_sd_levels, 1.0);
}

// Mutations: faults of a file that are not looked for; the file's severity in spite of an override.
TEST(Faults, StandInFilesAsWell) {
  const ScenarioFolder folder;
  const auto file = folder.write("small.yaml", kSmallScenario + "faults: {camera: {blur: 3, noise: 2}}\n");
  EXPECT_EQ(read_experiment(file).scenario.camera.defocus_sd_px,
            read_experiment(file, {"faults.camera.noise=1"}).scenario.camera.defocus_sd_px);
  EXPECT_GT(read_experiment(file).scenario.camera.defocus_sd_px, 0.0);
  EXPECT_EQ(read_experiment(file, {"faults.camera.noise=1"}).scenario.camera.noise_sd_levels, 4.0);
  const ScenarioFolder other;
  const auto plain = other.write("plain.yaml", written_out(file, {}, 1));
  EXPECT_EQ(read_experiment(plain).scenario.camera.noise_sd_levels, 8.0);
  EXPECT_THAT(with_overrides(plain, {}), Not(HasSubstr("faults")));
}

// What is believed is off from what is so, also where an override says that, and whatever was believed
// before. Mutations: off from the file's value; off from the belief; a sum for a product.
TEST(Faults, OfCalibrationAreOffFromTheRigAsItIs) {
  const ScenarioFolder folder;
  const auto file = folder.write("small.yaml", kSmallScenario + "believed_rig: {baseline_m: 7}\n");
  const std::vector<std::string> rig = {"rig.baseline_m=0.2", "rig.right_turn_deg=[1, 2, 3]",
                                        "rig.distortion=[-0.1, 0.02, 0, 0, 0]"};
  std::vector<std::string> overrides = rig;
  for (const char* name : {"calibration", "turn", "lens", "pitch"})
    overrides.push_back(fmt::format("faults.rig.{}=3", name));
  const worlds::Scenario off = read_experiment(file, overrides).scenario;
  EXPECT_EQ(off.rig.baseline_m, 0.2);
  EXPECT_DOUBLE_EQ(off.believed_rig.baseline_m, 0.2 * 1.005);
  EXPECT_DOUBLE_EQ(off.believed_rig.intrinsics.focal_px, 500 * 1.005);
  EXPECT_TRUE(off.believed_rig.right_turn_rad.isApprox(slam::kRadPerDegree * Eigen::Vector3d(1.1, 2.1, 3.1)));
  EXPECT_DOUBLE_EQ(off.believed_rig.distortion.k1, -0.1 + 0.01);
  EXPECT_EQ(off.believed_rig.distortion.k2, 0.02);
  EXPECT_GT(off.believed_rig.pitch_down_rad, 0.0);
  EXPECT_EQ(off.rig.pitch_down_rad, 0.0);
}

class BadFault : public testing::TestWithParam<BadOverride> {};

// Mutations: each check dropped.
TEST_P(BadFault, IsRefusedInALine) {
  worlds::expect_blamed(GetParam(), complaint_about_faults);
}
constexpr BadOverride kBadFaults[] = {
    {"faults.camera.blurr=1", "--set faults.camera.blurr: unknown key, did you mean blur?"},
    {"faults.lidar.noise=1", "--set faults.lidar: unknown key, expected one of detector, camera, rig"},
    {"faults.camera.blur=6", "--set faults.camera.blur: expected a whole number from 0 to 5 (got 6)"},
    {"faults.camera.blur=-1", "--set faults.camera.blur: expected a whole number from 0 to 5 (got -1)"},
    {"faults.camera.blur=1.5", "--set faults.camera.blur: expected a whole number from 0 to 5 (got 1.5)"},
    {"faults.camera.blur=", "--set faults.camera.blur: expected a whole number from 0 to 5 (got nothing)"},
    {"faults.camera=3", "--set faults.camera: expected a group of keys (got 3)"},
    {"faults=3", "--set faults: expected a group of keys (got 3)"},
    {"faults={detector: {swaps: 1, swaps: 2}}",
     "--set faults.detector.swaps: expected each key once (this one is repeated)"},
};
INSTANTIATE_TEST_SUITE_P(All, BadFault, testing::ValuesIn(kBadFaults));

// A severity beside a plain line for the same key says two things. Mutations: each of the ways to say it let
// pass; a line for another key of the group refused.
TEST(Faults, AreRefusedBesideALineForTheSameKey) {
  const ScenarioFolder folder;
  const auto file = folder.write("small.yaml", kSmallScenario);
  const std::string expected =
      "--set faults.camera.blur: it stands for camera.defocus_sd_px, which --set {} sets as well; expected "
      "one "
      "of the two";
  EXPECT_EQ(complaint_about_faults(file, {"camera.defocus_sd_px=1", "faults.camera.blur=2"}),
            fmt::format(fmt::runtime(expected), "camera.defocus_sd_px"));
  EXPECT_EQ(complaint_about_faults(file, {"faults.camera.blur=2", "camera={defocus_sd_px: 1}"}),
            fmt::format(fmt::runtime(expected), "camera"));
  EXPECT_NO_THROW(read_experiment(file, {"camera={vignette: 0.1}", "faults.camera.blur=2"}));
  EXPECT_NO_THROW(read_experiment(file, {"camera.defocus_sd_px=1", "faults.camera.blur=0"}));
  EXPECT_THAT(
      complaint_about_faults(file, {"believed_rig.right_turn_deg[0]=1", "faults.rig.turn=2"}),
      HasSubstr("believed_rig.right_turn_deg, which --set believed_rig.right_turn_deg[0] sets as well"));
  const auto with_faults = folder.write("faulty.yaml", kSmallScenario + "faults: {camera: {blur: 2}}\n");
  EXPECT_THAT(
      complaint_about_faults(with_faults, {"camera.defocus_sd_px=1"}),
      StartsWith(with_faults.string() + ":34: faults.camera.blur: it stands for camera.defocus_sd_px"));
}

// Mutation: the later one wins.
TEST(Faults, AreRefusedWhereTwoSetTheSameKey) {
  const ScenarioFolder folder;
  const auto file = folder.write("small.yaml", kSmallScenario);
  EXPECT_EQ(complaint_about_faults(file, {"faults.detector.miss_bursts=1", "faults.detector.misses=2"}),
            "--set faults.detector.miss_bursts: it stands for detector_noise.miss_probability, which --set "
            "faults.detector.misses sets as well; expected one of the two");
}

// Mutations: faults of cameras that do nothing to an oracle; faults of all detectors refused; a complaint of
// a key that nobody has written.
TEST(Faults, OfThingsThatAnOracleDoesNotHaveAreRefusedByName) {
  const ScenarioFolder folder;
  const auto file = folder.write("small.yaml", kSmallScenario);
  for (const char* name : {"camera.blur", "camera.motion_blur", "camera.vignette", "rig.turn", "rig.drops"})
    EXPECT_EQ(complaint_about_faults(file, {"sensor=oracle", fmt::format("faults.{}=1", name)}),
              fmt::format("--set faults.{}: this fault is of cameras, and the oracle has none", name));
  EXPECT_NO_THROW(read_experiment(file, {"sensor=oracle", "faults.camera.blur=0"}));
  EXPECT_THAT(complaint_about_faults(file, {"sensor=oracle", "faults.detector.centre_noise=1"}),
              StartsWith("--set faults.detector.centre_noise: detector_noise.centre_sd_px: the oracle has no "
                         "pixels;"));
  EXPECT_EQ(
      read_experiment(file, {"sensor=oracle", "faults.detector.misses=1"}).detector_noise->miss_probability,
      0.05);
}

// What a reader refuses of a value is blamed on the fault that has put it there. Mutation: on the plain key.
TEST(Faults, AreToBlameForWhatTheySet) {
  const ScenarioFolder folder;
  const auto file = folder.write("unnamed.yaml", small_scenario_with("identity: known", "identity: none") +
                                                     "faults:\n  detector:\n    swaps: 1\n");
  EXPECT_THAT(complaint_about_faults(file),
              StartsWith(file.string() + ":36: faults.detector.swaps: "
                                         "detector_noise.identity_swap_probability: identity is none:"));
  const auto bad = folder.write("bad.yaml", small_scenario_with("baseline_m: 0.1", "baseline_m: hello"));
  EXPECT_THAT(complaint_about_faults(bad, {"faults.rig.calibration=1"}),
              EndsWith(":8: rig.baseline_m: expected a number from 0.001 to 10 (got hello)"));
  const auto without = folder.write(
      "without.yaml",
      small_scenario_with(
          "rig: {width_px: 640, height_px: 480, focal_px: 500, baseline_m: 0.1, height_m: 0.3}\n", ""));
  EXPECT_THAT(complaint_about_faults(without, {"sensor=radar", "faults.rig.calibration=1"}),
              EndsWith(": rig.baseline_m: this key is missing and has no default"));
  const auto odd = folder.write("odd.yaml", small_scenario_with("{noise_sd_levels: 1}", "3"));
  EXPECT_THAT(complaint_about_faults(odd, {"faults.camera.blur=1"}),
              EndsWith(":9: camera: expected a group of keys (got 3)"));
}

}  // namespace
}  // namespace stereobench::harness
