// Everything that a scenario file can have wrong about what is run: each is refused in one line that names
// the place and the cure. What it says of worlds, tests/worlds/scenario/bad_scenario_test.cpp has.
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

using testing::EndsWith;
using testing::StartsWith;
using worlds::BadOverride;
using worlds::Fault;
using worlds::kSmallScenario;
using worlds::ScenarioFolder;
using worlds::small_scenario_with;

std::string complaint_about(const std::filesystem::path& file,
                            const std::vector<std::string>& overrides = {}) {
  return complaint_of([&] { read_experiment(file, overrides); });
}

class BadExperiment : public testing::TestWithParam<Fault> {};

// Catches: a check dropped, a line counted from 0, a key path without its group, an unchecked leftover key.
TEST_P(BadExperiment, IsRefusedInOneLineThatNamesPlaceAndExpectation) {
  worlds::expect_refused(GetParam(), complaint_about);
}

constexpr Fault kFaults[] = {
    {"particles: 20", "particels: 20", "4: particels: unknown key, did you mean particles?"},
    {"at_least: 0.9", "atleast: 0.9", "33: gates[0].atleast: unknown key, did you mean at_least?"},
    {"seeds: 0..2", "seeds: 2..0", "3: seeds: expected seeds such as 0..9, 3 or 0,4,7"},
    {"seeds: 0..2", "seeds: 1,1", "3: seeds: expected seeds"},
    {"seeds: 0..2", "seeds: 0..9999999", "3: seeds: expected seeds"},
    {"seeds: 0..2", "seeds: -1", "3: seeds: expected seeds"},
    {"particles: 20", "particles: 20.5", "4: particles: expected a whole number from 1 to 100000 (got 20.5)"},
    {"particles: 20", "particles: 0", "4: particles: expected a whole number from 1 to 100000 (got 0)"},
    {"particles: 20", "particles: 99999999999", "4: particles: expected a whole number from 1 to 100000"},
    {"particles: 20", "particles: \"20\"",
     "4: particles: expected a whole number from 1 to 100000 (got \"20\")"},
    {"ufastslam]", "kalman]", "5: filters[1]: expected one of dead_reckoning, "},
    {"particles: 20", "draw_every: 0", "4: draw_every: expected a whole number from 1 to 100000 (got 0)"},
    {"ufastslam]", "dead_reckoning]", "5: filters[1]: expected each filter once (got dead_reckoning)"},
    {"filters: [dead_reckoning, ufastslam]", "filters: []",
     "5: filters: expected a list of 1 to 16 (got a list of 0)"},
    {"particles: 20", "association: best", "4: association: expected one of individual, joint (got best)"},
    {"at_least: 0.9", "at_least: 0.9, at_most: 1", "33: gates[0]: expected either at_most or at_least"},
    {", at_least: 0.9", "", "33: gates[0]: expected either at_most or at_least"},
    {"at_least: 0.9", "at_least: much", "33: gates[0].at_least: expected a number"},
};
INSTANTIATE_TEST_SUITE_P(Faults, BadExperiment, testing::ValuesIn(kFaults));

TEST(BadBelief, OfAnOracleThatIsNotThere) {
  const ScenarioFolder folder;
  const auto file = folder.write(
      "bad.yaml", small_scenario_with(
                      "oracle: {range_sd_m: 0.1, bearing_sd_deg: 1, max_range_m: 20, field_of_view_deg: 90}",
                      "believed_oracle: {max_range_m: 8}"));
  EXPECT_THAT(complaint_about(file),
              EndsWith("bad.yaml:10: believed_oracle: expected `oracle:` beside it, the sensor as it is"));
}

TEST(BadDetector, LooksAtNoPicturesOfAnOracle) {
  const ScenarioFolder folder;
  const auto file = folder.write("small.yaml", kSmallScenario);
  EXPECT_THAT(complaint_about(file, {"sensor=oracle", "detector=ours"}),
              StartsWith("--set detector: the oracle has no pictures to look at"));
}

class BadRunOverrides : public testing::TestWithParam<BadOverride> {};

// Catches: an override blamed on the file, an unknown key that is quietly added.
TEST_P(BadRunOverrides, AreBlamedOnTheCommandLine) {
  worlds::expect_blamed(GetParam(), complaint_about);
}
constexpr BadOverride kBadOverrides[] = {
    {"particles=many", "--set particles: expected a whole number from 1 to 100000 (got many)"},
    {"particles=", "--set particles: expected a whole number from 1 to 100000 (got nothing)"},
    {"believed_odometry_noise.v=1", "--set believed_odometry_noise.v: unknown key"},
    {"believed_oracle.range_sd_m=8", "--set believed_oracle.range_sd_m: unknown key"},
    {"believed_measurement_noise.range_sd_m=1", "--set believed_measurement_noise.kind: this key is missing"},
    {"believed_measurement_noise.kind=laser",
     "--set believed_measurement_noise.kind: expected one of per_observation, constant, stereo, file (got "
     "laser)"},
    {"believed_measurement_noise={kind: per_observation, range_sd_m: 1}",
     "--set believed_measurement_noise.range_sd_m: unknown key"},
    {"believed_measurement_noise={kind: constant, disparity_sd_px: 1}",
     "--set believed_measurement_noise.disparity_sd_px: unknown key"},
    {"believed_measurement_noise={kind: stereo, disparity_sd_px: -1, bearing_sd_px: 1}",
     "--set believed_measurement_noise.disparity_sd_px: expected a number from 0 to 100 (got -1)"},
};
INSTANTIATE_TEST_SUITE_P(All, BadRunOverrides, testing::ValuesIn(kBadOverrides));

}  // namespace
}  // namespace stereobench::harness
