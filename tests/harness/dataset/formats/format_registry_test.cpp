/// What holds for every data-set format: each row of the registry, and the one that contributing.md shows.
#include "harness/dataset/formats/format_registry.h"

#include <algorithm>
#include <map>
#include <set>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "harness/dataset/seed_render.h"
#include "tests/harness/dataset/formats/example_format.h"
#include "tests/harness/dataset/formats/written_drive.h"

namespace stereobench::harness {

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::ThrowsMessage;

bool is_picture(const std::string& name) {
  return name.ends_with(".png") || name.ends_with(".pfm");
}

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

  WrittenDataset render(FrameChoice frames = {}) const {
    const worlds::Scenario& scenario = experiment_.scenario;
    GetParam().check(drive_of(scenario, scenario.world, 0));
    const RenderTask task = {.experiment = &experiment_,
                             .frames = frames,
                             .truth = {},
                             .datasets = {{&GetParam(), place_, {{"seed", 0}}}}};
    return render_seeds({task}, 1, "").front().datasets.front();
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

// Looking takes time, and what was seen is only in the log of the plain format. Mutations: always looked;
// never looked.
TEST_P(EveryFormat, AsksADetectorOnlyForSightings) {
  Experiment experiment = experiment_;
  experiment.detector.command = "exit 1";
  const RenderTask task = {.experiment = &experiment,
                           .frames = {},
                           .truth = {},
                           .datasets = {{&GetParam(), place_, {{"seed", 0}}}}};
  if (GetParam().has_sightings)
    EXPECT_THROW(render_seeds({task}, 1, ""), std::runtime_error);
  else
    EXPECT_EQ(render_seeds({task}, 1, "").front().datasets.front().pairs, 3);
}

// Mutation: a writer's file that is not listed.
TEST_P(EveryFormat, WritesADriveAndListsAllOfIt) {
  EXPECT_EQ(render().pairs, 3);
  const nlohmann::json told = marker();
  std::set<std::string> listed = {"manifest-sha256.txt"}, there;
  for (const auto& [name, hash] : read_manifest(place_)) listed.insert(name);
  for (const auto& [name, bytes] : files()) {
    there.insert(name);
    EXPECT_FALSE(bytes.empty()) << name;
  }
  EXPECT_EQ(there, listed);
  EXPECT_EQ(told.at("frames"), nlohmann::json({0, 1, 2}));
  EXPECT_TRUE(render().was_complete);
}

// Law: a step's pictures do not depend on which steps are asked for, but for the name where a format counts
// its frames. Mutation: files named by how many came before.
TEST_P(EveryFormat, WritesTheSameOfSomeSteps) {
  render({.first = 1, .last = 2});
  const std::map<std::string, std::string> some = files();
  fs::remove_all(place_);
  render();
  const std::map<std::string, std::string> whole = files();
  std::size_t pictures = 0;
  for (const auto& [name_of_some, bytes] : some) {
    if (!is_picture(name_of_some)) continue;
    std::string name = name_of_some;
    if (GetParam().name == "kitti-odometry") ++name.at(name.size() - 5);  // of 000000.png
    ++pictures;
    ASSERT_TRUE(whole.contains(name)) << name;
    EXPECT_EQ(whole.at(name), bytes) << name;
  }
  const bool has_pictures =
      std::ranges::any_of(whole, is_picture, &std::pair<const std::string, std::string>::first);
  EXPECT_GE(pictures, has_pictures ? 4U : 0U);  // those in containers: tests/readers
}

// Mutation: what is there already left out of the list.
TEST_P(EveryFormat, GoesOnAfterAnInterruption) {
  render();
  const std::map<std::string, std::string> whole = files();
  folder_.write("data/dataset.unfinished.json", R"({"seed": 0})");
  fs::remove(place_ / "manifest-sha256.txt");
  fs::path first_picture;
  for (const auto& [name, bytes] : whole)
    if (!name.ends_with(".png")) {
      fs::remove(place_ / name);
    } else if (first_picture.empty()) {
      first_picture = place_ / name;
    }
  const auto written = first_picture.empty() ? fs::file_time_type() : fs::last_write_time(first_picture);
  EXPECT_EQ(render().pairs, 3);
  EXPECT_EQ(files(), whole);
  if (!first_picture.empty()) {
    EXPECT_EQ(fs::last_write_time(first_picture), written);
  }
}

// Mutation: names of a format that the manifest takes for no files of its own.
TEST_P(EveryFormat, NoticesASpoiltFileOfEachFolder) {
  render();
  const std::map<std::string, std::string> whole = files();
  std::map<fs::path, std::string> of_folder;
  for (const auto& [name, bytes] : whole)
    if (!name.starts_with("manifest") && name != "dataset.json")
      of_folder[fs::path(name).parent_path()] = name;
  for (const auto& [parent, name] : of_folder) {
    std::string spoilt = whole.at(name);
    spoilt.back() = static_cast<char>(spoilt.back() ^ 1);
    folder_.write("data/" + name, spoilt);
    EXPECT_EQ(render().spoilt, std::vector<std::string>{name});
    EXPECT_EQ(files(), whole) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryFormat, testing::ValuesIn(all_formats()), [](const auto& test) {
  std::string name(test.param.name);
  std::ranges::replace(name, '-', '_');
  return name;
});

TEST(FormatRegistry, HasEachNameOnceAndOursFirst) {
  std::set<std::string_view> names;
  for (const DatasetFormat& format : dataset_formats()) {
    EXPECT_TRUE(names.insert(format.name).second) << format.name;
    EXPECT_EQ(&dataset_format(format.name), &format);
  }
  EXPECT_EQ(dataset_formats().front().name, "plain");
}

// Mutation: no suggestion.
TEST(FormatRegistry, SaysWhichFormatsThereAre) {
  EXPECT_THAT(
      [] { dataset_format("tun"); },
      ThrowsMessage<std::runtime_error>(HasSubstr(
          "--format: no format is called 'tun', did you mean tum?; there are plain, kitti-odometry, ")));
}

}  // namespace
}  // namespace stereobench::harness
