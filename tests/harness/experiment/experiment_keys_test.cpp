// The declared keys of a scenario file: those of worlds and those of a run, as one table.
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/experiment/experiment.h"
#include "tests/complaint.h"
#include "tests/worlds/scenario/read_scenario.h"
#include "tests/worlds/scenario/scenario_text.h"
#include "tests/worlds/yaml/declared_keys.h"

namespace stereobench::harness {
namespace {

using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::StartsWith;
using worlds::ScenarioFolder;
using worlds::small_scenario_with;

std::vector<std::string> complaints_about(const std::filesystem::path& file,
                                          const std::vector<std::string>& overrides = {}) {
  return complaints_of([&] { read_experiment(file, overrides); });
}

// Both tables complain together. Mutations: each checked for itself; stopping at the first complaint.
TEST(ExperimentKeys, ComplaintsNameAllUnknownAndMissingKeysAtOnce) {
  const ScenarioFolder folder;
  std::string text = small_scenario_with("particles: 20", "particels: 20");
  text.replace(text.find("{colour: 1, "), 12, "{color: 1, ");
  text.replace(text.find("  speed_mps: 0.5\n"), 17, "");
  text.replace(text.find("identity: known\n"), 16, "");
  const auto file = folder.write("bad.yaml", text);
  const std::string at = file.string() + ":";
  EXPECT_THAT(complaints_about(file, {"camera.gian=2", "rig.x=1"}),
              ElementsAre(StartsWith(at + "4: particels: unknown key, did you mean particles?"),
                          StartsWith("--set rig.x: unknown key"),
                          StartsWith("--set camera.gian: unknown key, did you mean gain?"),
                          StartsWith(at + "11: path.speed_mps: this key is missing"),
                          StartsWith(at + "28: world.balls[1].color: unknown key, did you mean colour?"),
                          StartsWith(at + "1: identity: this key is missing")));
}

// Mutation: a key declared and not read (also by a line of a reader lost).
TEST(ExperimentKeys, AreAllRead) {
  const ScenarioFolder folder;
  const auto file = folder.write("small.yaml", small_scenario_with("  floor: bricks\n", ""));
  const auto complaints = [&](const auto& overrides) { return complaints_about(file, overrides); };
  EXPECT_GT(expect_all_read(experiment_keys(), complaints), 200U);
}

// Mutation: a key that says nothing.
TEST(ExperimentKeys, SayWhatTheyAreWhenLeftOut) {
  const ScenarioFolder folder;
  const auto file = folder.write("small.yaml", worlds::bare_small_scenario());
  const auto complaints = [&](const auto& overrides) { return complaints_about(file, overrides); };
  expect_defaults_said(experiment_keys(), complaints);
}

/// The names of all keys at the top, in their order.
std::vector<std::string> names_of(const worlds::KeyGroup& group) {
  std::vector<std::string> names;
  for (const worlds::Key& key : group.keys) names.emplace_back(key.name);
  return names;
}

// The keys of worlds are all there, as they are there, and the others are those that worlds' tests leave out.
// Mutations: a key of worlds lost; the kinds of sensors lost.
TEST(ExperimentKeys, AreThoseOfWorldsAndThoseOfARun) {
  const std::vector<std::string> known(worlds::kKeysOfRuns.begin(), worlds::kKeysOfRuns.end());
  std::vector<std::string> of_worlds;
  std::vector<std::string> of_runs;
  for (const std::string& name : names_of(experiment_keys()))
    (std::ranges::find(known, name) == known.end() ? of_worlds : of_runs).push_back(name);
  EXPECT_THAT(of_worlds, ElementsAreArray(names_of(worlds::scenario_keys())));
  EXPECT_THAT(of_runs, testing::UnorderedElementsAreArray(known));
  EXPECT_EQ(experiment_keys().kind_key, worlds::scenario_keys().kind_key);
  for (const std::string& name : of_worlds) {
    const worlds::Key& here = *experiment_keys().find(name);
    const worlds::Key& there = *worlds::scenario_keys().find(name);
    EXPECT_EQ(here.fallback, there.fallback) << name;
    EXPECT_EQ(here.required, there.required) << name;
    EXPECT_EQ(here.required_for, there.required_for) << name;
    EXPECT_EQ(here.group, there.group) << name;
  }
}

// People know the page by this order. Mutation: the keys of a run behind those of worlds.
TEST(ExperimentKeys, StandInTheOrderOfTheReferencePage) {
  EXPECT_THAT(names_of(experiment_keys()),
              ElementsAre("name", "description", "filters", "particles", "draw_every", "seeds", "gates",
                          "sensor", "identity", "association", "colour_spacing_m", "rig", "believed_rig",
                          "camera", "shutter", "detector", "detector_timeout_s", "detector_start_s",
                          "detector_noise", "perfect_detections", "faults", "oracle", "believed_oracle",
                          "odometry_noise", "believed_odometry_noise", "start_noise", "believed_start_noise",
                          "believed_measurement_noise", "path", "placement_jitter_m", "randomise", "world"));
}

}  // namespace
}  // namespace stereobench::harness
