/// Collections as they are written down, and what of them is refused.
#include "harness/collection/collection.h"

#include <gmock/gmock.h>

#include "harness/collection/collection_plan.h"
#include "tests/test_folder.h"

namespace stereobench::harness {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A collection's file beside a scenario that is not read.
class WrittenCollection {
 public:
  explicit WrittenCollection(const std::string& text) : file_(folder_.write("set.yaml", text)) {}
  Collection read() const { return read_collection(file_); }
  std::string complaint() const {
    try {
      read();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "none";
  }

 private:
  TestFolder folder_;
  std::filesystem::path file_;
};

// Mutation: seeds of train and test exchanged.
TEST(CollectionFile, IsReadWhole) {
  const WrittenCollection written(R"(dataset: trial
about: {licence: CC0-1.0, published: 2026-01-31}
formats: [tum, plain]
truth: [flow, disparity]
truth_format: kitti
drives:
  - name: one
    scenario: worlds/one.yaml
    set: [path.laps=1]
    frames: 0..90:10
    seeds: {train: 0..2, test: 7}
    variations:
      - name: dim
        set: [light.ambient=0.1]
  - {name: two, scenario: two.yaml, seeds: {val: "3,5"}}
)");
  const Collection collection = written.read();
  EXPECT_EQ(collection.name, "trial");
  EXPECT_EQ(collection.about.published, "2026-01-31");
  ASSERT_EQ(collection.formats.size(), 2U);
  EXPECT_EQ(collection.formats.front()->name, "tum");
  EXPECT_THAT(collection.truth.kinds, ElementsAre(TruthKind::kDisparity, TruthKind::kFlow));
  EXPECT_EQ(collection.truth.format, TruthFormat::kKitti);
  ASSERT_EQ(collection.drives.size(), 2U);
  const DriveGroup& one = collection.drives.front();
  EXPECT_TRUE(one.scenario.is_absolute());
  EXPECT_EQ(one.scenario.filename(), "one.yaml");
  EXPECT_EQ(one.frames.stride, 10U);
  EXPECT_THAT(one.seeds_of[0], ElementsAre(0, 1, 2));
  EXPECT_THAT(one.seeds_of[2], ElementsAre(7));
  EXPECT_EQ(folder_name(one, one.variations.front()), "one-dim");
  EXPECT_THAT(collection.drives[1].seeds_of[1], ElementsAre(3, 5));
  EXPECT_EQ(folder_name(collection.drives[1], collection.drives[1].variations.front()), "two");
}

// Law: no world, that is a scenario with a seed, is in two splits, whatever its variations and groups.
TEST(CollectionFile, HasEachWorldInOneSplit) {
  EXPECT_THAT(
      WrittenCollection("dataset: a\ndrives:\n"
                        "  - {name: x, scenario: one.yaml, seeds: {train: 0..4, test: 4}}\n")
          .complaint(),
      HasSubstr("set.yaml:3: drives[0].seeds: expected each world in one split: seed 4 of one.yaml is "
                "in train and in test"));
  const std::string two =
      "dataset: a\ndrives:\n"
      "  - {name: x, scenario: one.yaml, seeds: {train: 0..4}}\n"
      "  - {name: y, scenario: sub/../one.yaml, set: [camera.gain=2], seeds: {";
  EXPECT_THAT(WrittenCollection(two + "val: 3}}\n").complaint(),
              HasSubstr("drives[1].seeds: expected each world in one split: seed 3 of one.yaml"));
  EXPECT_EQ(WrittenCollection(two + "train: 3, val: 5}}\n").complaint(), "none");
}

// One line each, with file, line and key.
TEST(CollectionFile, SaysWhatIsWrongWhere) {
  const std::string head = "dataset: a\n", drives = "drives:\n  - name: x\n    scenario: one.yaml\n";
  const std::string good = drives + "    seeds: {train: 0}\n";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {head, "set.yaml:1: drives: "},
      {head + drives, "set.yaml:3: drives[0].seeds: "},
      {head + drives + "    seeds: {}\n", "drives[0].seeds"},
      {head + drives + "    seeds: {train: a}\n", "set.yaml:5: drives[0].seeds.train: "},
      {head + drives + "    seeds: {trian: 1}\n", "drives[0].seeds.trian"},
      {head + good + "    frames: 9..3\n", "set.yaml:6: drives[0].frames: expected frames such as 7"},
      {head + good + "    set: [path]\n", "drives[0].set[0]: expected key.path=value"},
      {"dataset: a/b\n" + good, "set.yaml:1: dataset: expected letters, digits, _ and -"},
      {head + "formats: [tun]\n" + good,
       "set.yaml:2: formats[0]: no format is called 'tun', did you mean tum?"},
      {head + "formats: [tum, tum]\n" + good, "formats[1]: expected each format once"},
      {head + "truth: [depth]\n" + good, "set.yaml:2: truth[0]: "},
      {head + "formats: [tum]\ntruth: [flow]\n" + good, "set.yaml:3: truth: expected the format plain"},
      {head + "about: {published: yesterday}\n" + good, "set.yaml:2: about.published: expected a date"},
      {head + good + "  - {name: x, scenario: b.yaml, seeds: {test: 1}}\n", "expected a name of its own"},
      {head + good + "    variations: [{name: a}, {name: a}]\n", "expected a name of its own"},
  };
  for (const auto& [text, expected] : cases) {
    const std::string complaint = WrittenCollection(text).complaint();
    EXPECT_THAT(complaint, HasSubstr(expected)) << text;
    EXPECT_EQ(complaint.find('\n'), std::string::npos) << complaint;
  }
}

TEST(CollectionFile, ChangesPictures) {
  const std::string rest = "\ndrives: [{name: one, scenario: one.yaml, seeds: {train: 0}}]\n";
  const WrittenCollection written(
      "dataset: trial\npictures: {every: 3, crop: [8, 4, 64, 32], scale: 1/2, kind: bayer-rggb}" + rest);
  const PictureChange change = written.read().change;
  EXPECT_EQ(change.every, 3U);
  EXPECT_EQ(change.crop, cv::Rect(8, 4, 64, 32));
  EXPECT_EQ(change.divide, 2);
  EXPECT_EQ(change.kind, PictureKind::kBayer);
  for (const auto& [line, complaint] :
       {std::pair("pictures: {scale: 0.5}", "set.yaml:2: pictures.scale: expected 1/N, as 1/2 (got 0.5)"),
        std::pair("pictures: {crop: [1, 2, 3]}", "set.yaml:2: pictures.crop: expected a list of 4"),
        std::pair("pictures: {crop: [0, 0, 0, 3]}", "set.yaml:2: pictures.crop[2]: expected a whole number"),
        std::pair("pictures: {every: 0}", "set.yaml:2: pictures.every: expected a whole number"),
        std::pair("pictures: {kind: rgb}",
                  "set.yaml:2: pictures.kind: expected one of colour, grey, bayer-rggb, linear16")})
    EXPECT_THAT(WrittenCollection(std::string("dataset: trial\n") + line + rest).complaint(),
                HasSubstr(complaint));
}

}  // namespace
}  // namespace stereobench::harness
