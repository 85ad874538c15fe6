/// `stereobench schema` and the reader of scenarios say the same: held against python3-jsonschema, which
/// knows nothing of either.
#include <charconv>
#include <cstdlib>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <yaml-cpp/yaml.h>

#include "harness/experiment/experiment.h"
#include "harness/reference/scenario_schema.h"
#include "tests/harness/commands/program.h"
#include "tests/worlds/scenario/minimal_group.h"
#include "tests/worlds/scenario/scenario_text.h"
#include "worlds/yaml/yaml_document.h"

namespace stereobench::harness {
namespace {

using Json = nlohmann::ordered_json;
using testing::HasSubstr;
using worlds::Context;
using worlds::Key;

/// YAML as JSON: what is a number, a flag or text as our reader takes it.
Json json_of(const YAML::Node& node) {
  if (node.IsSequence()) {
    Json list = Json::array();
    for (const YAML::Node& entry : node) list.push_back(json_of(entry));
    return list;
  }
  if (node.IsMap()) {
    Json map = Json::object();
    for (const auto& entry : node) map[entry.first.Scalar()] = json_of(entry.second);
    return map;
  }
  if (!node.IsScalar()) return nullptr;
  const std::string& text = node.Scalar();
  if (node.Tag() == "!") return text;
  if (text == "true" || text == "false") return text == "true";
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return text;
  const auto whole = static_cast<long>(number);
  return text.find_first_not_of("-0123456789") == std::string::npos ? Json(whole) : Json(number);
}

/// Skipped without Debian's python3-jsonschema (scripts/packages.txt).
class Schema : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("/usr/bin/python3 -c 'import jsonschema' 2>/dev/null") != 0)
      GTEST_SKIP() << "no python3-jsonschema";
  }
};

/// What python3-jsonschema says of documents: one line each, empty where it is right.
class Validator {
 public:
  void add(const Json& document) { documents_.push_back(document); }
  std::vector<std::string> verdicts() const {
    const TestFolder scratch;
    scratch.write("schema.json", scenario_schema().dump());
    scratch.write("documents.json", documents_.dump());
    const std::string script = scratch.write("validate.py", R"(
import json, jsonschema, sys
schema = json.load(open(sys.argv[1] + "/schema.json"))
jsonschema.Draft7Validator.check_schema(schema)
validator = jsonschema.Draft7Validator(schema)
with open(sys.argv[1] + "/verdicts", "w") as out:
    for document in json.load(open(sys.argv[1] + "/documents.json")):
        error = next(validator.iter_errors(document), None)
        out.write((error.message[:200].replace("\n", " ") if error else "") + "\n")
)");
    const std::string command = "/usr/bin/python3 -W ignore " + script + " " + scratch.path().string();
    EXPECT_EQ(std::system(command.c_str()), 0);
    std::ifstream file(scratch.path() / "verdicts");
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    EXPECT_EQ(lines.size(), documents_.size());
    lines.resize(documents_.size());
    return lines;
  }

 private:
  Json documents_ = Json::array();
};

bool is_read(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  try {
    read_experiment(file, overrides);
  } catch (const std::exception&) {
    return false;
  }
  return true;
}

// Mutations: a key, a kind or a range that the schema does not have.
TEST_F(Schema, AcceptsEveryShippedScenario) {
  Validator validator;
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(STEREOBENCH_SOURCE_DIR "/assets/scenarios")) {
    if (entry.path().extension() != ".yaml") continue;
    names.push_back(entry.path().filename());
    validator.add(json_of(YAML::LoadFile(entry.path())));
  }
  ASSERT_GE(names.size(), 5U);
  const auto verdicts = validator.verdicts();
  for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(verdicts[i], "") << names[i];
}

/// A value that is not what a key may be, or that just may.
struct Probe {
  std::string path;
  std::vector<std::string> overrides;
  bool is_right;
};

/// For each key of each group: nothing that it could be, and numbers at and beyond their bounds.
std::vector<Probe> probes() {
  std::vector<Probe> probes;
  for (const Context& context : worlds::all_contexts(experiment_keys()))
    for (const Key* const key : worlds::keys_of(context)) {
      const auto probe = [&](const std::string& value, bool is_right) {
        probes.push_back({path_of(context, key->name) + "=" + value,
                          worlds::overrides_with(context, *key, value), is_right});
      };
      probe("[[[]]]", false);
      const bool is_number =
          key->kind == worlds::ValueKind::kNumber || key->kind == worlds::ValueKind::kWhole;
      if (!is_number || key->lengths.most > 0) continue;
      probe(fmt::format("{}", key->within.least), true);
      probe(fmt::format("{}", key->within.most + 1.0), false);
      probe(fmt::format("{}", key->within.least - 1.0), false);
      if (key->kind == worlds::ValueKind::kWhole) probe("1.5", false);
    }
  return probes;
}

// Law: what the schema refuses, the reader refuses; and of single values, within bounds and beyond, of each
// key of each kind of group, the schema accepts exactly what it should. Mutations: a bound of the schema off
// by one; a key of one kind let pass for all; a group left open.
TEST_F(Schema, AndReaderAgreeAboutEveryKey) {
  const worlds::ScenarioFolder folder;
  std::string text = worlds::small_scenario_with("  floor: bricks\n", "");
  const auto file = folder.write("small.yaml", text);
  Validator validator;
  const std::vector<Probe> all = probes();
  ASSERT_GT(all.size(), 400U);
  for (const Probe& probe : all)
    validator.add(json_of(worlds::load_yaml(file, probe.overrides, experiment_keys()).root));
  const auto verdicts = validator.verdicts();
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(verdicts[i].empty(), all[i].is_right) << all[i].path << ": " << verdicts[i];
    if (verdicts[i].empty()) continue;
    EXPECT_FALSE(is_read(file, all[i].overrides)) << all[i].path;
  }
}

// Mutation: unknown or missing keys let pass.
TEST_F(Schema, KnowsWhichKeysThereAreAndWhichMustBe) {
  Validator validator;
  const auto document = [](const std::string& piece, const std::string& instead) {
    return json_of(YAML::Load(worlds::small_scenario_with(piece, instead)));
  };
  validator.add(document("particles: 20", "particels: 20"));
  validator.add(document("identity: known\n", ""));
  validator.add(document("laps: 1", "closed: true"));
  validator.add(document("  step_s: 0.5\n", ""));
  validator.add(document("at_least: 0.9", "at_least: 0.9, at_most: 1"));
  validator.add(document("{colour: 1, ", "{"));
  validator.add(document("seeds: 0..2", "seeds: 2-5"));
  validator.add(document("seeds: 0..2", "seeds: 3"));
  const auto verdicts = validator.verdicts();
  for (std::size_t i = 0; i + 1 < verdicts.size(); ++i) EXPECT_NE(verdicts[i], "") << i;
  EXPECT_EQ(verdicts.back(), "");
}

TEST(SchemaCommand, PrintsIt) {
  const Outcome outcome = run_stereobench({"schema"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(Json::parse(outcome.out), scenario_schema());
  EXPECT_THAT(outcome.out, HasSubstr("\"description\": \"Focal length, in pixels.\""));
}

}  // namespace
}  // namespace stereobench::harness
