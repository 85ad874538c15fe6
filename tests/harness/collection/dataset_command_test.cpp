/// Collections in one piece and in parts, joined, spoilt and taken up.
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "harness/io/sha256.h"
#include "tests/harness/collection/small_collection.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A collection in one piece, for all tests: rendering takes a while.
class WholeCollection : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch_ = new TestFolder;
    file_ = write_collection(*scratch_);
    outcome_ = dataset("whole", {"--jobs", "2"});
  }
  static void TearDownTestSuite() { delete scratch_; }
  void SetUp() override { ASSERT_EQ(outcome_.exit_code, 0) << outcome_.err; }

  static Outcome dataset(const std::string& out, const std::vector<std::string>& more) {
    return run_stereobench(with({"dataset", file_.string(), "--out", place(out).string()}, more));
  }
  static Outcome merge(const std::vector<std::string>& shards, const std::string& out) {
    std::vector<std::string> words = {"merge"};
    for (const std::string& shard : shards) words.push_back(place(shard).string());
    return run_stereobench(with(words, {"--out", place(out).string()}));
  }
  static fs::path place(const std::string& name) { return scratch_->path() / name; }

  static inline TestFolder* scratch_ = nullptr;
  static inline fs::path file_;
  static inline Outcome outcome_;
};

// Mutation: the manifests of data sets left out of the list.
TEST_F(WholeCollection, IsListedToTheLastFile) {
  EXPECT_THAT(outcome_.out, HasSubstr("small: 12 data sets with 48 stereo pairs in "));
  EXPECT_TRUE(sha256sum_agrees(place("whole")));
  std::set<std::string> listed = {"manifest-sha256.txt"}, there;
  std::istringstream manifest(bytes_of(place("whole") / "manifest-sha256.txt"));
  for (std::string line; std::getline(manifest, line);) listed.insert(line.substr(66));
  for (const auto& [name, bytes] : files_below(place("whole"))) there.insert(name);
  EXPECT_EQ(there, listed);
  for (const char* name : {"train/circle-good/plain/seed_1/left/000003.png", "collection.json", "index.csv",
                           "test/circle-noisy/tum/seed_7/rgb.txt", "README.md", "croissant.json"})
    EXPECT_TRUE(there.contains(name)) << name;
  EXPECT_THAT(bytes_of(place("whole") / "index.csv"),
              HasSubstr("\ntest/circle-noisy/tum/seed_7,test,circle,noisy,tum,ball_circle,7,4\n"));
}

// Mutation: file sets of `train` alone.
TEST_F(WholeCollection, DescribesItself) {
  const std::string card = bytes_of(place("whole") / "README.md");
  EXPECT_THAT(card, HasSubstr("# small\n\nA test.\n"));
  EXPECT_THAT(card, HasSubstr("stereobench dataset small.yaml"));
  EXPECT_THAT(card, HasSubstr("`train/circle-noisy`"));
  EXPECT_THAT(card, HasSubstr("## Licence\n\nCC0-1.0\n"));
  const auto croissant = nlohmann::json::parse(bytes_of(place("whole") / "croissant.json"));
  EXPECT_EQ(croissant.at("license"), "CC0-1.0");
  std::set<std::string> globs;
  for (const nlohmann::json& one : croissant.at("distribution"))
    if (one.contains("includes")) globs.insert(one.at("includes").get<std::string>());
  for (const char* glob : {"train/*/plain/seed_*/left/*.png", "test/*/tum/seed_*/depth/*.png"})
    EXPECT_TRUE(globs.contains(glob)) << glob;
  EXPECT_EQ(croissant.at("recordSet").at(0).at("dataType"), "cr:Split");
  for (const auto& [name, bytes] : files_below(place("whole")))
    if (name.find('/') == std::string::npos) {
      EXPECT_EQ(bytes.find(scratch_->path().string()), std::string::npos) << name;
    }
}

// Law: a drive of a collection is, to the byte, what `render` writes of that seed alone.
TEST_F(WholeCollection, HasTheDrivesThatRenderWrites) {
  const fs::path alone = place("alone");
  ASSERT_EQ(run_stereobench({"render", scenario_path("ball_circle"), "--set", "rig.width_px=160", "--set",
                             "rig.height_px=120", "--set", "rig.focal_px=140", "--set", "path.laps=0.08",
                             "--set", "camera.noise_sd_levels=6", "--seed", "7", "--format", "plain,tum",
                             "--out", alone.string()})
                .exit_code,
            0);
  for (const char* format : {"plain", "tum"})
    EXPECT_TRUE(files_below(alone / format) ==
                files_below(place("whole") / "test/circle-noisy" / format / "seed_7"))
        << format;
}

// Law: however the drives are split over machines, the joined folder is the one in one piece, to the byte;
// and joining again changes nothing.
TEST_F(WholeCollection, IsTheSameInPartsAndJoined) {
  for (const char* part : {"1/3", "2/3", "3/3"}) {
    const Outcome outcome = dataset(std::string("part_") + part[0], {"--shard", part, "--jobs", "2"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out,
                HasSubstr(fmt::format("part {} of 3 is done; 8 of 12 data sets are missing", part[0])));
    EXPECT_FALSE(fs::exists(place(std::string("part_") + part[0]) / "manifest-sha256.txt"));
  }
  const Outcome early = merge({"part_1", "part_3"}, "early");
  EXPECT_EQ(early.exit_code, 2);
  EXPECT_THAT(early.err, HasSubstr("4 of 12 data sets are finished in no shard (the first: "));
  EXPECT_FALSE(fs::exists(place("early")));
  const Outcome joined = merge({"part_3", "part_1", "part_2"}, "joined");
  ASSERT_EQ(joined.exit_code, 0) << joined.err;
  EXPECT_THAT(joined.out, HasSubstr("12 data sets with 48 stereo pairs"));
  const auto whole = files_below(place("whole"));
  EXPECT_TRUE(files_below(place("joined")) == whole);
  fs::remove(place("joined") / "manifest-sha256.txt");  // as after a kill
  fs::remove(place("joined") / "train/circle-good/tum/seed_0/manifest-sha256.txt");
  fs::remove(place("joined") / "train/circle-good/tum/seed_0/rgb.txt");
  ASSERT_EQ(merge({"part_1", "part_2", "part_3"}, "joined").exit_code, 0);
  EXPECT_TRUE(files_below(place("joined")) == whole);
  ASSERT_EQ(merge({"part_1", "part_2", "part_3"}, "part_2").exit_code, 0);  // into one of them
  EXPECT_TRUE(files_below(place("part_2")) == whole);
}

/// Changes a file of a data set and its hash in the manifest, as if it had been rendered so.
void render_otherwise(const fs::path& dataset, const std::string& name) {
  const std::string before = bytes_of(dataset / name), after = before + "x";
  std::string manifest = bytes_of(dataset / "manifest-sha256.txt");
  manifest.replace(manifest.find(sha256_of(before)), 64, sha256_of(after));
  fs::remove(dataset / name);
  std::ofstream(dataset / name, std::ios::binary) << after;
  std::ofstream(dataset / "manifest-sha256.txt", std::ios::binary) << manifest;
}

// Mutation: hashes not compared.
TEST_F(WholeCollection, IsNotJoinedWhereShardsContradictEachOther) {
  fs::copy(place("whole"), place("other"), fs::copy_options::recursive);
  const std::string dataset = "train/circle-good/plain/seed_1";
  render_otherwise(place("other") / dataset, "left/000002.png");
  const Outcome outcome = merge({"whole", "other"}, "contradiction");
  EXPECT_EQ(outcome.exit_code, 5);
  for (const char* shard : {"whole", "other"})
    EXPECT_THAT(outcome.err, HasSubstr((place(shard) / dataset / "left/000002.png").string()));
  EXPECT_THAT(outcome.err, HasSubstr("have different bytes"));
  EXPECT_FALSE(fs::exists(place("contradiction")));
}

// A flipped bit is no contradiction, and is not passed on. Mutation: linked without a look.
TEST_F(WholeCollection, IsNotJoinedFromSpoiltFiles) {
  fs::copy(place("whole"), place("spoilt"), fs::copy_options::recursive);
  const fs::path victim = place("spoilt") / "test/circle-good/tum/seed_7/rgb.txt";
  std::ofstream(victim, std::ios::app) << "x";
  const Outcome outcome = merge({"spoilt"}, "from_spoilt");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr(victim.string() + ": is not as it was rendered"));
  EXPECT_FALSE(fs::exists(place("from_spoilt") / "manifest-sha256.txt"));
}

// What is finished is not written again; what is missing or spoilt is.
TEST_F(WholeCollection, IsTakenUpAndLeftAsItIs) {
  fs::copy(place("whole"), place("again"), fs::copy_options::recursive);
  fs::remove_all(place("again") / "test/circle-good");
  std::ofstream(place("again") / "train/circle-good/plain/seed_0/balls.csv", std::ios::app) << "x";
  const auto before = times_below(place("again"));
  const Outcome outcome = dataset("again", {"--jobs", "2"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err,
              HasSubstr("1 files were missing or not as they had been written (the first: balls.csv)"));
  EXPECT_TRUE(files_below(place("again")) == files_below(place("whole")));
  const auto after = times_below(place("again"));
  for (const auto& [name, time] : before)
    if (name.find("noisy") != std::string::npos) {
      EXPECT_EQ(after.at(name), time) << name;
    }
}

// Mutation: drives that are gone from the file left lying.
TEST_F(WholeCollection, RefusesWhatItHasNot) {
  fs::copy(place("whole"), place("old"), fs::copy_options::recursive);
  std::string text = bytes_of(file_);
  text.replace(text.find("0..1"), 4, "0");
  const fs::path fewer = scratch_->write("fewer.yaml", text);
  const Outcome outcome = run_stereobench({"dataset", fewer.string(), "--out", place("old").string()});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("seed_1: is a data set that small no longer has; remove it or choose"));
  EXPECT_EQ(dataset("whole/train/circle-good/plain/seed_0", {}).exit_code, 2);
  EXPECT_TRUE(sha256sum_agrees(place("whole")));
}

// Nothing is made before all scenarios are read.
TEST_F(WholeCollection, ChecksEverythingFirst) {
  const Outcome dry = dataset("dry", {"--dry-run", "--shard", "2/6"});
  EXPECT_EQ(dry.exit_code, 0);
  EXPECT_THAT(dry.out, HasSubstr("small: would render frames 0..3 of seed 1 to "));
  EXPECT_FALSE(fs::exists(place("dry")));
  std::string text = bytes_of(file_);
  text.replace(text.find("noise_sd_levels"), 15, "noise_sd_level");
  const fs::path wrong = scratch_->write("wrong.yaml", text);
  const Outcome outcome = run_stereobench({"dataset", wrong.string(), "--out", place("dry").string()});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("camera.noise_sd_level"));
  EXPECT_FALSE(fs::exists(place("dry")));
}

}  // namespace
}  // namespace stereobench::harness
