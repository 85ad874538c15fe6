// The declared keys of a scenario: what the reader asks for, what people are told, and all complaints at
// once.
#include "worlds/yaml/key_group.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/complaint.h"
#include "tests/worlds/scenario/read_scenario.h"
#include "tests/worlds/scenario/scenario_text.h"
#include "tests/worlds/yaml/declared_keys.h"

namespace stereobench::worlds {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

std::vector<std::string> complaints_about(const std::filesystem::path& file,
                                          const std::vector<std::string>& overrides = {}) {
  return complaints_of([&] { read_scenario(file, overrides); });
}

// Mutations: stopping at the first complaint; not looking below lists; leaving out what is missing.
TEST(Complaints, NameAllUnknownAndMissingKeysAtOnce) {
  const ScenarioFolder folder;
  std::string text = small_scenario_with("description:", "descripton:");
  text.replace(text.find("{colour: 1, "), 12, "{color: 1, ");
  text.replace(text.find("  speed_mps: 0.5\n"), 17, "");
  text.replace(text.find("identity: known\n"), 16, "");
  const auto file = folder.write("bad.yaml", text);
  const std::string at = file.string() + ":";
  EXPECT_THAT(complaints_about(file, {"camera.gian=2", "rig.x=1"}),
              ElementsAre(StartsWith(at + "2: descripton: unknown key, did you mean description?"),
                          StartsWith("--set rig.x: unknown key"),
                          StartsWith("--set camera.gian: unknown key, did you mean gain?"),
                          StartsWith(at + "11: path.speed_mps: this key is missing"),
                          StartsWith(at + "28: world.balls[1].color: unknown key, did you mean colour?"),
                          StartsWith(at + "1: identity: this key is missing")));
}

// Mutations: an entry in place of the list; a place counted from 1; the file's list where it has none.
TEST(Overrides, SetEntriesOfLists) {
  const ScenarioFolder folder;
  const auto file = folder.write("small.yaml", kSmallScenario);
  const Scenario scenario = read_scenario(
      file, {"world.balls[0].colour=7", "world.balls[1].at_m[1]=3.5", "world.walls[0].corners_m[2][0]=4.5",
             "rig.distortion[0]=-0.05", "believed_rig.right_turn_deg[1]=0.05"});
  EXPECT_EQ(scenario.world.balls[0].colour, 7);
  EXPECT_EQ(scenario.world.balls[1].centre_m, Eigen::Vector3d(0.0, 3.5, 0.1));
  EXPECT_EQ(scenario.world.walls[1].to_m, Eigen::Vector2d(4.5, 4.0));
  EXPECT_EQ(scenario.rig.distortion.k1, -0.05);
  EXPECT_EQ(scenario.believed_rig.distortion.k1, -0.05) << "what is believed is what is, but for the turn";
  EXPECT_EQ(scenario.rig.right_turn_rad, Eigen::Vector3d(0.0, 0.0, 0.0));
  EXPECT_NEAR(scenario.believed_rig.right_turn_rad.y(), 0.05 * 3.14159265358979 / 180.0, 1e-15);
}

// What is believed is what is, entry by entry. Mutation: the declared default in place of the true rig's
// list.
TEST(Overrides, AnEntryOfWhatIsBelievedLeavesTheOthersAsTheyAre) {
  const ScenarioFolder folder;
  const auto file = folder.write("small.yaml", kSmallScenario);
  const Scenario scenario =
      read_scenario(file, {"rig.distortion=[-0.1, 0.02, 0, 0, 0]", "believed_rig.distortion[0]=-0.09"});
  EXPECT_EQ(scenario.believed_rig.distortion.k1, -0.09);
  EXPECT_EQ(scenario.believed_rig.distortion.k2, 0.02);
  EXPECT_EQ(scenario.rig.distortion.k1, -0.1);
}

TEST(Overrides, OfEntriesThatAreNotThereAreRefused) {
  const ScenarioFolder folder;
  const auto file = folder.write("small.yaml", kSmallScenario);
  const auto complaint = [&](const std::string& text) { return complaints_about(file, {text}).at(0); };
  EXPECT_THAT(complaint("world.balls[3].colour=1"),
              EndsWith("expected a place from 0 to 2 (the list has 3 entries)"));
  EXPECT_THAT(complaint("world.balls[-1].colour=1"), HasSubstr("expected the place of an entry in brackets"));
  EXPECT_THAT(complaint("world.balls[x].colour=1"), HasSubstr("expected the place of an entry in brackets"));
  EXPECT_THAT(complaint("world.balls[0=1"), HasSubstr("expected the place of an entry in brackets"));
  EXPECT_THAT(complaint("world.balls.colour=1"), HasSubstr("e.g. world.balls[0]"));
  EXPECT_THAT(complaint("camera[0]=1"), HasSubstr("expected a list there"));
  EXPECT_THAT(complaint("nothing[0]=1"), HasSubstr("expected a list there"));
  EXPECT_THAT(complaint("rig.distortion[0]=much"),
              StartsWith("--set rig.distortion[0]: expected a number from -100 to 100"));
}

// Mutation: a key declared and not read (also by a line of a reader lost).
TEST(DeclaredKeys, AreAllRead) {
  const ScenarioFolder folder;
  const auto file = folder.write("small.yaml", small_scenario_with("  floor: bricks\n", ""));
  const auto complaints = [&](const auto& overrides) { return complaints_about(file, overrides); };
  EXPECT_GT(expect_all_read(scenario_keys(), complaints), 150U);
}

// Mutation: a key that says nothing.
TEST(DeclaredKeys, SayWhatTheyAreWhenLeftOut) {
  const ScenarioFolder folder;
  const auto file = folder.write("small.yaml", bare_small_scenario());
  const auto complaints = [&](const auto& overrides) { return complaints_about(file, overrides); };
  expect_defaults_said(scenario_keys(), complaints);
}

}  // namespace
}  // namespace stereobench::worlds
