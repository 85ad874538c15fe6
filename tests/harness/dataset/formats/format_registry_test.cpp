/// What holds for every data-set format: each row of the registry, and the one that contributing.md shows.
#include "harness/dataset/formats/format_registry.h"

#include <algorithm>
#include <map>
#include <set>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "harness/dataset/seed_render.h"
#include "tests/harness/dataset/formats/example_format.h"
#include "tests/harness/dataset/step_writer.h"

namespace stereobench::harness {

void PrintTo(const DatasetFormat& format, std::ostream* out) {
  *out << format.name;
}

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::vector<DatasetFormat> all_formats() {
  std::vector<DatasetFormat> all(dataset_formats().begin(), dataset_formats().end());
  all.push_back(kExampleFormat);
  return all;
}

class EveryFormat : public testing::TestWithParam<DatasetFormat> {
 protected:
  const TestFolder folder_;
  const fs::path place_ = folder_.path() / "data";
  const Experiment experiment_ = {.scenario = room_drive()};

  RenderedSeed render(FrameChoice frames = {}) const {
    GetParam().check(experiment_.scenario, {});
    const RenderTask task = {.experiment = &experiment_,
                             .format = &GetParam(),
                             .frames = frames,
                             .truth = {},
                             .folder = place_,
                             .identity = {{"seed", 0}}};
    return render_seeds({task}, 1, "").front();
  }
  nlohmann::json marker() const { return nlohmann::json::parse(folder_.read("data/dataset.json")); }

  /// The bytes of all files.
  std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(place_))
      if (entry.is_regular_file()) {
        const std::string name = fs::relative(entry.path(), place_).generic_string();
        files[name] = folder_.read("data/" + name);
      }
    return files;
  }
};

// Mutation: a writer's file that is not listed.
TEST_P(EveryFormat, WritesADriveAndListsAllOfIt) {
  EXPECT_EQ(render().pairs, 3);
  const nlohmann::json told = marker();
  std::set<std::string> listed = {"dataset.json"}, there;
  for (const auto& [name, facts] : told.at("files").items()) listed.insert(name);
  for (const auto& [name, bytes] : files()) {
    there.insert(name);
    EXPECT_FALSE(bytes.empty()) << name;
  }
  EXPECT_EQ(there, listed);
  EXPECT_EQ(told.at("frames"), nlohmann::json({0, 1, 2}));
  EXPECT_TRUE(render().was_complete);
}

// Law: a step's files do not depend on which steps are asked for. They lie in folders; those of the whole
// drive may lie beside them. Mutation: files named by how many came before.
TEST_P(EveryFormat, WritesTheSameOfAStepAlone) {
  render({.first = 1, .last = 1});
  std::map<std::string, std::string> alone = files();
  fs::remove_all(place_);
  render();
  const std::map<std::string, std::string> whole = files();
  std::size_t in_folders = 0;
  for (const auto& [name, bytes] : alone) {
    if (!fs::path(name).has_parent_path()) continue;
    ++in_folders;
    ASSERT_TRUE(whole.contains(name)) << name;
    EXPECT_EQ(whole.at(name), bytes) << name;
  }
  EXPECT_GE(in_folders, 2U);
}

// Mutation: what is there already left out of the list.
TEST_P(EveryFormat, GoesOnAfterAnInterruption) {
  render();
  const std::map<std::string, std::string> whole = files();
  folder_.write("data/dataset.unfinished.json", R"({"seed": 0})");
  fs::remove(place_ / "dataset.json");
  fs::path first_picture;
  for (const auto& [name, bytes] : whole)
    if (!name.ends_with(".png")) {
      fs::remove(place_ / name);
    } else if (first_picture.empty()) {
      first_picture = place_ / name;
    }
  const auto written = fs::last_write_time(first_picture);
  EXPECT_EQ(render().pairs, 3);
  EXPECT_EQ(files(), whole);
  EXPECT_EQ(fs::last_write_time(first_picture), written);
}

// Mutation: names of a format that dataset.json takes for no files of its own.
TEST_P(EveryFormat, NoticesASpoiltFileOfEachFolder) {
  render();
  const std::map<std::string, std::string> whole = files();
  std::map<fs::path, std::string> of_folder;
  for (const auto& [name, bytes] : whole)
    if (name != "dataset.json") of_folder[fs::path(name).parent_path()] = name;
  for (const auto& [parent, name] : of_folder) {
    std::string spoilt = whole.at(name);
    spoilt.back() = static_cast<char>(spoilt.back() ^ 1);
    folder_.write("data/" + name, spoilt);
    EXPECT_EQ(render().spoilt, std::vector<std::string>{name});
    EXPECT_EQ(files(), whole) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryFormat, testing::ValuesIn(all_formats()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(FormatRegistry, HasEachNameOnceAndOursFirst) {
  std::set<std::string_view> names;
  for (const DatasetFormat& format : dataset_formats()) {
    EXPECT_TRUE(names.insert(format.name).second) << format.name;
    EXPECT_EQ(&dataset_format(format.name), &format);
  }
  EXPECT_EQ(dataset_formats().front().name, "stereobench");
}

// Mutation: no suggestion.
TEST(FormatRegistry, SaysWhichFormatsThereAre) {
  EXPECT_THAT(
      [] { dataset_format("kity"); },
      ThrowsMessage<std::runtime_error>(HasSubstr(
          "--format: no format is called 'kity', did you mean kitti?; there are stereobench, kitti")));
}

}  // namespace
}  // namespace stereobench::harness
