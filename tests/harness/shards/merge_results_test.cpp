#include "harness/shards/merge_results.h"

#include <fstream>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/io/sha256.h"
#include "harness/json/cbor.h"
#include "harness/shards/shard_conflict.h"
#include "harness/store/answer_store.h"
#include "tests/complaint.h"
#include "tests/test_folder.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

constexpr std::size_t kShards = 3;

const std::function<void(double)> kSilent = [](double) {};

std::string key_of_drive(int number) {
  return sha256_of("drive " + std::to_string(number));
}

/// A result as drives have them: with numbers that are not finite, and the time that it took.
std::string result_of_drive(int number, double seconds, double error_m = 0.25) {
  return bytes_of(
      nlohmann::json{{"seed", number},
                     {"runs", {{{"ate_m", error_m}, {"map_m", std::numeric_limits<double>::quiet_NaN()}}}},
                     {"timing", {{"render", seconds}}}});
}

/// Three shards with two drives each; the first drive of each is the last one of the shard before.
class OverlappingShards {
 public:
  OverlappingShards() {
    for (std::size_t i = 0; i < kShards; ++i) {
      folders_.push_back(scratch_.path() / ("s" + std::to_string(i + 1)));
      fs::create_directories(folders_.back());
      ShardWork(folders_.back(), record(i));
      for (const int number : {static_cast<int>(i), static_cast<int>(i) + 1})
        add(i, number, result_of_drive(number, 0.1 * static_cast<double>(i)));
    }
  }
  ShardRecord record(std::size_t shard) const {
    return {.command = {"stereobench", "run"},
            .folder = "/",
            .version = "1",
            .shard = {shard + 1, kShards},
            .plan = "plan",
            .pixels = "pixels",
            .store = kDrivesFile,
            .drives = 2};
  }
  void add(std::size_t shard, int number, const std::string& result) {
    AnswerStore(file(shard)).append(key_of_drive(number), result);
  }
  void finish() {
    for (std::size_t i = 0; i < folders_.size(); ++i) ShardWork(folders_[i], record(i)).finish();
  }
  fs::path file(std::size_t shard) const { return folders_[shard] / kDrivesFile; }
  const std::vector<fs::path>& folders() const { return folders_; }
  fs::path out() const {
    fs::create_directories(scratch_.path() / "out");
    return scratch_.path() / "out";
  }
  std::string conflict() const {
    try {
      check_shards(folders_);
      merge_results(folders_, out(), kSilent);
    } catch (const ShardConflict& conflict) {
      return conflict.what();
    }
    return "no conflict";
  }

 private:
  TestFolder scratch_;
  std::vector<fs::path> folders_;
};

// Law: a union by key; what differs in time alone is the same. Mutation: bytes compared as they are.
TEST(MergeResults, IsTheUnionByKey) {
  OverlappingShards shards;
  shards.finish();
  EXPECT_EQ(check_shards(shards.folders()).plan, "plan");
  for (int times = 0; times < 2; ++times) {  // again, as after a kill
    merge_results(shards.folders(), shards.out(), kSilent);
    const AnswerStore merged(shards.out() / kDrivesFile);
    EXPECT_EQ(merged.size(), 4U);
    for (int number = 0; number < 4; ++number)
      EXPECT_EQ(json_of(merged.read(key_of_drive(number)))["seed"], number);
  }
}

// The alarm that a machine computes differently, however little. Mutations: no comparison, or the first
// of two taken.
TEST(MergeResults, OfOneChangedBitNameBothFilesAndThePlace) {
  OverlappingShards shards;
  shards.add(2, 0, result_of_drive(0, 0.1, std::nextafter(0.25, 1.0)));
  shards.finish();
  EXPECT_THAT(shards.conflict(), AllOf(HasSubstr(shards.file(0).string()), HasSubstr(shards.file(2).string()),
                                       HasSubstr("/runs/0/ate_m: 0.25 and 0.25000000000000006"),
                                       HasSubstr("computes differently")));
  EXPECT_FALSE(fs::exists(shards.out() / kDrivesFile));
}

// Whatever bit of a shard's file changes after it was written: its name is said. Mutation: damaged records
// passed over, as by a run that takes itself up again.
TEST(MergeResults, OfAFileThatHasChangedNameIt) {
  OverlappingShards shards;
  shards.finish();
  const auto size = static_cast<std::streamoff>(fs::file_size(shards.file(1)));
  for (std::streamoff place = 0; place < size; place += 7) {
    std::fstream file(shards.file(1), std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(place);
    const char before = static_cast<char>(file.get());
    file.seekp(place);
    file.put(static_cast<char>(before ^ 4)).flush();
    EXPECT_THAT(shards.conflict(), AllOf(HasSubstr(shards.file(1).string()), HasSubstr("changed"))) << place;
    file.seekp(place);
    file.put(before).flush();
  }
  EXPECT_EQ(shards.conflict(), "no conflict");
  fs::resize_file(shards.file(1), static_cast<std::uintmax_t>(size) - 1);
  EXPECT_THAT(shards.conflict(), HasSubstr("the file has changed behind byte"));
  fs::remove(shards.file(1));
  EXPECT_THAT(shards.conflict(), HasSubstr("is gone"));
}

// Mutations: a missing, an unfinished or a strange shard accepted.
TEST(CheckShards, WantsAllOfThemFinishedAndOfTheSameWork) {
  OverlappingShards shards;
  EXPECT_THAT(complaint_of([&] { check_shards(shards.folders()); }),
              HasSubstr("3 of 3 shards are not finished: 1, 2, 3"));
  shards.finish();
  const auto& folders = shards.folders();
  EXPECT_EQ(complaint_of([&] {
              check_shards({folders[2], folders[0], folders[1], folders[1]});
            }),
            "no complaint");
  EXPECT_THAT(complaint_of([&] {
                check_shards({folders[0], folders[2]});
              }),
              HasSubstr("1 of 3 shards are missing: 2; run them with --shard N/3"));
  ShardRecord other = shards.record(1);
  other.command.push_back("more");
  const auto put = [&] {
    fs::remove(folders[1] / kShardFile);
    ShardWork(folders[1], other).finish();
  };
  put();
  EXPECT_THAT(complaint_of([&] { check_shards(folders); }), HasSubstr("are shards of different commands"));
  other = shards.record(1);
  other.plan = "another";
  put();
  EXPECT_THAT(shards.conflict(), HasSubstr("a file that the command reads, or the program, has changed"));
  other.pixels = "other pixels";
  put();
  EXPECT_THAT(shards.conflict(), HasSubstr("render different pixels (pixels and other pixels"));
  EXPECT_THROW(check_shards({shards.out()}), std::runtime_error);
}

}  // namespace
}  // namespace stereobench::harness
