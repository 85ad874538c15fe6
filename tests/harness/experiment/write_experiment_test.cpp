// Scenario files written out.
#include "harness/experiment/write_experiment.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/experiment/experiment.h"
#include "tests/worlds/scenario/scenario_text.h"

namespace stereobench::harness {
namespace {

using testing::ElementsAre;
using worlds::kSmallScenario;
using worlds::ScenarioFolder;

// Mutations: the file's own seeds kept; the seed's world written and its jitter kept.
TEST(WrittenOut, ASeedsWorldIsOfThatSeedAlone) {
  const ScenarioFolder folder;
  const auto file = folder.write("small.yaml", kSmallScenario);
  const ScenarioFolder other;
  const Experiment plain = read_experiment(other.write("plain.yaml", written_out(file, {}, 7)));
  EXPECT_THAT(plain.seeds, ElementsAre(7));
  EXPECT_EQ(plain.scenario.placement_jitter_m, 0.0);
  EXPECT_EQ(plain.particles, 20) << "what is run stays as it is";
  EXPECT_THAT(read_experiment(other.write("plain.yaml", written_out(file))).seeds, ElementsAre(0, 1, 2));
}

// Mutation: the file's name kept as it is.
TEST(WrittenOut, FindsItsNoiseFromAnotherFolder) {
  const ScenarioFolder folder;
  folder.write("noise.yaml", "{kind: constant, range_sd_m: 0.3, bearing_sd_deg: 3}\n");
  const auto file = folder.write(
      "small.yaml", kSmallScenario + "believed_measurement_noise: {kind: file, file: noise.yaml}\n");
  const ScenarioFolder other;
  const Experiment again = read_experiment(other.write("copy.yaml", written_out(file)));
  EXPECT_EQ(again.believed.measurement_noise.value().range_sd_m, 0.3);
}

// Mutation: an override lost.
TEST(WithOverrides, ChangesWhatTheyNameAndNothingElse) {
  const ScenarioFolder folder;
  const auto file = folder.write("small.yaml", kSmallScenario);
  const std::string text = with_overrides(file, {"particles=7"});
  EXPECT_THAT(text, testing::HasSubstr("\nparticles: 7\n"));
  EXPECT_THAT(text, testing::HasSubstr("file: thing.obj"));
  EXPECT_THAT(files_named_in(file, {"path={kind: recorded, file: drive.txt, step_s: 1}"}),
              ElementsAre("drive.txt", "thing.obj"));
}

// The list's default comes first. Mutation: the table of keys is not handed on, as it was not: `run` then
// refused what it had read.
TEST(WithOverrides, SetAnEntryOfAListThatTheFileLeavesOut) {
  const ScenarioFolder folder;
  const auto file = folder.write("small.yaml", kSmallScenario);
  const std::vector<std::string> overrides = {"rig.distortion[1]=0.02", "believed_rig.right_turn_deg[0]=0.1"};
  const ScenarioFolder other;
  const auto copy = other.write("copy.yaml", with_overrides(file, overrides));
  EXPECT_EQ(read_experiment(copy).scenario.rig.distortion.k2, 0.02);
  EXPECT_EQ(read_experiment(copy).scenario.rig.distortion.k1, 0.0);
  EXPECT_EQ(files_named_in(file, overrides), files_named_in(file, {}));
}

}  // namespace
}  // namespace stereobench::harness
