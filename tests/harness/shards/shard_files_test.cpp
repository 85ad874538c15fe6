/// shard.json and costs.json.
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/shards/drive_costs.h"
#include "harness/shards/shard_record.h"
#include "tests/complaint.h"
#include "tests/test_folder.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;

ShardRecord some_record() {
  return {.command = {"stereobench", "run", "a b.yaml", "--seeds", "0..9"},
          .folder = "/somewhere",
          .version = "1.2",
          .shard = {2, 3},
          .plan = "abc",
          .pixels = "p",
          .store = "results",
          .drives = 4,
          .needs_measured = true};
}

TEST(ShardRecord, IsReadAsItWasWritten) {
  const TestFolder folder;
  begin_shard(folder.path(), some_record());
  EXPECT_FALSE(read_shard_record(folder.path()).is_finished);
  finish_shard(folder.path(), some_record());
  const ShardRecord record = read_shard_record(folder.path());
  EXPECT_TRUE(record.is_finished);
  EXPECT_EQ(record.command, some_record().command);
  EXPECT_EQ(record.folder, "/somewhere");
  EXPECT_EQ(record.version, "1.2");
  EXPECT_EQ(record.shard.in_words(), "2 of 3");
  EXPECT_EQ(record.plan, "abc");
  EXPECT_EQ(record.pixels, "p");
  EXPECT_EQ(record.store, "results");
  EXPECT_EQ(record.drives, 4U);
  EXPECT_TRUE(record.needs_measured);
}

// Mutations: the plan, the command or the number not compared; a finished shard that stays finished while it
// is taken up again.
TEST(ShardRecord, OfOtherWorkIsNotTakenUp) {
  const TestFolder folder;
  begin_shard(folder.path(), some_record());
  finish_shard(folder.path(), some_record());
  for (int what = 0; what < 4; ++what) {
    ShardRecord other = some_record();
    if (what == 0) other.plan = "abd";
    if (what == 1) other.command.back() = "0..8";
    if (what == 2) other.shard.number = 3;
    if (what == 3) other.shard.count = 4;
    EXPECT_THAT(complaint_of([&] { begin_shard(folder.path(), other); }), HasSubstr("is of another shard"));
  }
  begin_shard(folder.path(), some_record());
  EXPECT_FALSE(read_shard_record(folder.path()).is_finished);
}

TEST(ShardRecord, ThatIsNoneIsRefused) {
  const TestFolder folder;
  for (const char* text :
       {"", "{}", "[]", R"({"schema": 2})",
        R"({"schema": 1, "command": ["a", "b"], "folder": "", "stereobench": "", "shards": 3,
                              "shard": 4, "plan": "", "pixels": "", "store": "", "drives": 0, "needs_shard_0": false, "finished": true})"}) {
    folder.write(kShardFile, text);
    EXPECT_THAT(complaint_of([&] { read_shard_record(folder.path()); }), HasSubstr("shard.json: ")) << text;
  }
}

// Mutations: the sum in place of the mean; 0 for a kind that nobody measured.
TEST(DriveCosts, AreMeansOfTheirKind) {
  const TestFolder folder;
  EXPECT_EQ(DriveCosts().seconds("any"), 1.0);
  DriveCosts costs;
  costs.add("slow", 9.0);
  costs.add("slow", 11.0);
  costs.add("quick", 1.0);
  costs.measured_plan = "plan";
  folder.write(kCostsFile, costs.json());
  for (const DriveCosts& either : {costs, read_costs(folder.path() / kCostsFile)}) {
    EXPECT_EQ(either.seconds("slow"), 10.0);
    EXPECT_EQ(either.seconds("quick"), 1.0);
    EXPECT_EQ(either.seconds("unknown"), 7.0);
    EXPECT_EQ(either.measured_plan, "plan");
  }
  for (const char* text : {"", "{}", R"({"measured_plan": "", "kinds": {"a": {"seconds": -1, "drives": 1}}})",
                           R"({"measured_plan": "", "kinds": {"a": {"seconds": 1, "drives": 0}}})"}) {
    folder.write(kCostsFile, text);
    EXPECT_THAT(complaint_of([&] { read_costs(folder.path() / kCostsFile); }), HasSubstr("costs.json: "));
  }
}

}  // namespace
}  // namespace stereobench::harness
