/// shard.json and costs.json.
#include <array>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

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
  ShardWork(folder.path(), some_record());
  EXPECT_FALSE(read_shard_record(folder.path()).is_finished);
  ShardWork(folder.path(), some_record()).finish();
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
  ShardWork(folder.path(), some_record());
  ShardWork(folder.path(), some_record()).finish();
  for (int what = 0; what < 4; ++what) {
    ShardRecord other = some_record();
    if (what == 0) other.plan = "abd";
    if (what == 1) other.command.back() = "0..8";
    if (what == 2) other.shard.number = 3;
    if (what == 3) other.shard.count = 4;
    EXPECT_THAT(complaint_of([&] { ShardWork(folder.path(), other); }), HasSubstr("is of another shard"));
  }
  ShardWork(folder.path(), some_record());
  EXPECT_FALSE(read_shard_record(folder.path()).is_finished);
}

// A child does the shard until this process has looked. Mutations: no lock; one that ends when shard.json is
// written; a lock of shard.json, which is replaced.
TEST(ShardWork, IsDoneByOneProcess) {
  const TestFolder folder;
  std::array<int, 2> begun{}, seen{};
  ASSERT_EQ(::pipe(begun.data()) + ::pipe(seen.data()), 0);
  const pid_t child = ::fork();
  char byte = 0;
  if (child == 0) {
    const ShardWork work(folder.path(), some_record());
    const bool is_told = ::write(begun[1], "b", 1) == 1 && ::read(seen[0], &byte, 1) == 1;
    ::_exit(is_told ? 0 : 1);
  }
  ASSERT_EQ(::read(begun[0], &byte, 1), 1);
  for (int again = 0; again < 2; ++again) {
    EXPECT_TRUE(is_under_way(folder.path()));
    EXPECT_THAT(complaint_of([&] { ShardWork(folder.path(), some_record()); }),
                HasSubstr("another stereobench is writing"));
  }
  ASSERT_EQ(::write(seen[1], "s", 1), 1);
  int status = -1;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
  EXPECT_FALSE(is_under_way(folder.path()));
  for (const int end : {begun[0], begun[1], seen[0], seen[1]}) ::close(end);
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
