// Named faults: which keys a severity stands for, and that its levels are levels.
#include "harness/experiment/fault_presets.h"

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "harness/experiment/experiment.h"
#include "harness/experiment/write_experiment.h"
#include "tests/worlds/scenario/scenario_text.h"

namespace stereobench::harness {
namespace {

using worlds::kSmallScenario;
using worlds::ScenarioFolder;

std::string asked(const FaultPreset& preset, int severity) {
  return fmt::format("faults.{}={}", preset.name, severity);
}

/// All numbers of a level, in their order.
std::vector<double> numbers_of(const YAML::Node& node) {
  if (node.IsScalar()) return {node.as<double>()};
  std::vector<double> numbers;
  for (const auto& entry : node) {
    const auto some = numbers_of(node.IsMap() ? entry.second : YAML::Node(entry));
    numbers.insert(numbers.end(), some.begin(), some.end());
  }
  return numbers;
}

// Law: a fault is its keys, to the byte, and what they say can be read. Mutations: levels one off; the first
// key alone; `faults` left in what is written.
TEST(FaultPresets, StandForTheirKeys) {
  const ScenarioFolder folder;
  const auto file = folder.write("small.yaml", kSmallScenario);
  for (const FaultPreset& preset : fault_presets())
    for (int severity = 1; severity <= kMostSeverity; ++severity) {
      std::vector<std::string> plain;
      bool is_plain = true;
      for (const FaultSetting& setting : preset.settings) {
        plain.push_back(
            fmt::format("{}={}", setting.key, setting.levels.at(static_cast<std::size_t>(severity - 1))));
        is_plain = is_plain && setting.is == LevelIs::kValue;
      }
      EXPECT_NO_THROW(read_experiment(file, {asked(preset, severity)})) << asked(preset, severity);
      const std::string lines = with_overrides(file, {asked(preset, severity)});
      if (is_plain) {
        EXPECT_EQ(lines, with_overrides(file, plain)) << asked(preset, severity);
      }
      EXPECT_THAT(lines, testing::Not(testing::HasSubstr("faults")));
    }
}

// Mutations: severity 0 as 1; a group made for nothing.
TEST(FaultPresets, OfSeverityZeroChangeNothing) {
  const ScenarioFolder folder;
  const auto file = folder.write("small.yaml", kSmallScenario);
  for (const FaultPreset& preset : fault_presets())
    EXPECT_EQ(with_overrides(file, {asked(preset, 0)}), with_overrides(file, {})) << preset.name;
  EXPECT_EQ(with_overrides(file, {"faults={}"}), with_overrides(file, {}));
}

// Law: from one severity to the next each number of a level moves further the same way, or never. Mutation:
// two levels that change places.
TEST(FaultPresets, GrowWithSeverity) {
  for (const FaultPreset& preset : fault_presets()) {
    bool is_level = false;
    for (const FaultSetting& setting : preset.settings) {
      std::vector<std::vector<double>> levels;
      for (const std::string_view level : setting.levels)
        levels.push_back(numbers_of(YAML::Load(std::string(level))));
      for (std::size_t i = 0; i < levels.front().size(); ++i) {
        const double first_step = levels[1][i] - levels[0][i];
        for (std::size_t next = 1; next < levels.size(); ++next) {
          const double step = levels[next][i] - levels[next - 1][i];
          EXPECT_TRUE(first_step == 0.0 ? step >= 0.0 : step * first_step > 0.0)
              << preset.name << " " << setting.key << " severity " << next + 1;
          is_level = is_level || step != 0.0;
        }
      }
    }
    EXPECT_TRUE(is_level) << preset.name;
  }
}

// Mutations: a name that stands twice; a group that `faults:` does not have.
TEST(FaultPresets, AreKeysWithOneNameEach) {
  std::set<std::string_view> names;
  for (const FaultPreset& preset : fault_presets()) {
    EXPECT_TRUE(names.insert(preset.name).second) << preset.name;
    const worlds::Key* const key = worlds::declared_key(fault_keys(), preset.name);
    ASSERT_NE(key, nullptr) << preset.name;
    EXPECT_THAT(key->says, testing::HasSubstr(std::string(preset.says)));
    EXPECT_FALSE(preset.settings.empty()) << preset.name;
    for (const FaultSetting& setting : preset.settings) {
      const worlds::Key* const set = worlds::declared_key(experiment_keys(), setting.key);
      ASSERT_NE(set, nullptr) << setting.key;
      EXPECT_EQ(setting.is == LevelIs::kValue, set->same_as.empty()) << setting.key;
    }
    for (const std::string_view sentence : {preset.says, preset.why}) EXPECT_TRUE(sentence.ends_with("."));
  }
}

}  // namespace
}  // namespace stereobench::harness
