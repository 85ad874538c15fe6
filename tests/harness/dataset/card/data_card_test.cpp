/// What a data set says of itself, to people and to machines.
#include "harness/dataset/card/data_card.h"

#include <algorithm>
#include <regex>
#include <set>

#include <gmock/gmock.h>

#include "harness/dataset/card/croissant.h"
#include "harness/dataset/card/format_layout.h"
#include "harness/dataset/seed_render.h"
#include "tests/harness/dataset/formats/written_drive.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

/// A drive with all truth, in one format.
class CardOfEveryFormat : public testing::TestWithParam<DatasetFormat> {
 protected:
  CardOfEveryFormat() {
    const bool plain = is_plain(GetParam());
    nlohmann::ordered_json identity = {{"stereobench", "1.2.3"},
                                       {"seed", 4},
                                       {"asked_frames", "0..2"},
                                       {"set", {"world.balls=[]", "path.laps=1"}},
                                       {"drive", {{"name", "room"}}}};
    if (!plain) identity["format"] = GetParam().name;
    RenderTask task = {.experiment = &experiment_, .frames = {}, .truth = {}, .datasets = {}};
    if (plain) task.truth.kinds = parse_truth("all");
    task.datasets = {{&GetParam(), place_, identity}};
    render_seeds({task}, 1, "");
  }
  nlohmann::json croissant() const { return nlohmann::json::parse(folder_.read("data/croissant.json")); }

  const TestFolder folder_;
  const fs::path place_ = folder_.path() / "data";
  const Experiment experiment_ = {.scenario = room_drive()};
};

/// What fits a glob of Croissant: `*` stands for no `/`.
bool fits(const std::string& glob, const std::string& name) {
  const std::string escaped = std::regex_replace(glob, std::regex(R"([.+()\[\]])"), R"(\$&)");
  return std::regex_match(name, std::regex(std::regex_replace(escaped, std::regex(R"(\*)"), "[^/]*")));
}

// Law: whoever adds a format says what each of its files holds (format_layout.cpp).
TEST_P(CardOfEveryFormat, SaysWhatEachFileHolds) {
  for (const auto& [name, hash] : read_manifest(place_)) {
    const bool is_own = name == "dataset.json" || name == "README.md" || name == "croissant.json";
    EXPECT_TRUE(is_own || layout_entry_of(GetParam().name, name) != nullptr) << name;
  }
  EXPECT_THAT(folder_.read("data/README.md"), Not(HasSubstr("see the documentation of the format")));
}

// Law: each file is in Croissant's distribution once, itself or as one of a set; hashes are those of the
// manifest, and records name files that there are.
TEST_P(CardOfEveryFormat, ListsEachFileInCroissant) {
  const nlohmann::json told = croissant();
  std::map<std::string, std::string> objects;
  std::vector<std::string> globs;
  std::set<std::string> ids;
  for (const nlohmann::json& one : told.at("distribution")) {
    EXPECT_TRUE(ids.insert(one.at("@id")).second) << one;
    if (one.at("@type") == "cr:FileSet") globs.push_back(one.at("includes"));
    if (one.at("@type") == "cr:FileObject") objects[one.at("contentUrl")] = one.at("sha256");
  }
  for (const auto& [name, hash] : read_manifest(place_)) {
    if (name == "croissant.json") continue;
    const auto of_set = std::ranges::count_if(globs, [&](const auto& glob) { return fits(glob, name); });
    EXPECT_LE(of_set, 1) << name;
    EXPECT_TRUE(of_set == 1 || objects.contains(name)) << name;
    EXPECT_EQ(objects.contains(name) ? objects.at(name) : hash, hash) << name;
  }
  for (const nlohmann::json& records : told.at("recordSet"))
    for (const nlohmann::json& field : records.at("field")) {
      const nlohmann::json& source = field.at("source");
      EXPECT_TRUE(ids.contains(source.contains("fileSet") ? source["fileSet"]["@id"]
                                                          : source.at("fileObject").at("@id")));
    }
}

// Whoever reads the card can make the same; it tells nothing of the machine.
TEST_P(CardOfEveryFormat, SaysHowItWasMadeAndNotWhere) {
  const std::string card = folder_.read("data/README.md");
  EXPECT_THAT(card, HasSubstr(std::string("# room, seed 4\n\n3 stereo pairs of one drive") +
                              (GetParam().name == "mrclam" ? " as a log, without the pictures" : "") +
                              ", with exact truth.\n"));
  EXPECT_THAT(card, HasSubstr("stereobench 1.2.3 made it"));
  EXPECT_THAT(card, HasSubstr("    stereobench render room.yaml --set 'world.balls=[]' --set path.laps=1 "
                              "--seeds 4 --frames 0..2"));
  const std::string format = " --format " + std::string(GetParam().name);
  EXPECT_EQ(card.find(format) != std::string::npos, !is_plain(GetParam()));
  for (const char* name : {"README.md", "croissant.json", "dataset.json", "manifest-sha256.txt"})
    EXPECT_THAT(folder_.read("data/" + std::string(name)), Not(HasSubstr(folder_.path().string()))) << name;
}

INSTANTIATE_TEST_SUITE_P(Registry, CardOfEveryFormat,
                         testing::ValuesIn(dataset_formats().begin(), dataset_formats().end()),
                         [](const auto& test) {
                           std::string name(test.param.name);
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

// What the specification asks for, and nothing that nobody said.
TEST(Croissant, HasWhatTheSpecificationAsksFor) {
  const auto told =
      nlohmann::json::parse(croissant_text({.name = "a",
                                            .description = "b",
                                            .version = "1",
                                            .licence = "CC0-1.0",
                                            .creator = "c",
                                            .url = "d",
                                            .published = "2026-01-31"},
                                           nlohmann::ordered_json::array(), nlohmann::ordered_json::array()));
  EXPECT_EQ(told.at("@type"), "sc:Dataset");
  EXPECT_EQ(told.at("conformsTo"), "http://mlcommons.org/croissant/1.0");
  EXPECT_EQ(told.at("@context").at("recordSet"), "cr:recordSet");
  EXPECT_EQ(told.at("@context").at("cr"), "http://mlcommons.org/croissant/");
  EXPECT_EQ(told.at("license"), "CC0-1.0");
  EXPECT_EQ(told.at("creator").at("name"), "c");
  EXPECT_EQ(told.at("datePublished"), "2026-01-31");
  const auto silent = nlohmann::json::parse(
      croissant_text({}, nlohmann::ordered_json::array(), nlohmann::ordered_json::array()));
  for (const char* key : {"creator", "url", "datePublished"}) EXPECT_FALSE(silent.contains(key)) << key;
}

// Columns have types by their names.
TEST(Croissant, KnowsWhatColumnsHold) {
  const nlohmann::json records = table_records("frames.csv", "step,t_s,filename,landmark_id");
  std::vector<std::string> types;
  for (const nlohmann::json& field : records.at("field")) types.push_back(field.at("dataType"));
  EXPECT_THAT(types, testing::ElementsAre("sc:Integer", "sc:Float", "sc:Text", "sc:Integer"));
  EXPECT_EQ(records["field"][1]["source"]["extract"]["column"], "t_s");
}

}  // namespace
}  // namespace stereobench::harness
