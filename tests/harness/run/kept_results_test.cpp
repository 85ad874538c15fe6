// Results of drives that were finished before are read by several threads, and handed on in order.
#include <utility>

#include <gtest/gtest.h>

#include "harness/io/sha256.h"
#include "harness/run/seed_result.h"
#include "harness/store/answer_store.h"
#include "tests/test_folder.h"

namespace stereobench::harness {
namespace {

/// A task whose result `store` already has, so that nothing is driven.
DriveTask kept_task(AnswerStore& store, std::uint64_t seed, const std::string& bytes) {
  DriveTask task{.seed = seed, .key = sha256_of(std::to_string(seed))};
  store.append(task.key, bytes);
  return task;
}

void expect_in_order(std::uint64_t count, int jobs) {
  const TestFolder folder;
  AnswerStore store(folder.path() / kDrivesFile);
  std::vector<DriveTask> tasks;
  for (std::uint64_t seed = 0; seed < count; ++seed)
    tasks.push_back(kept_task(store, seed, to_bytes({.seed = seed, .csv = std::string(97 * seed, 'x')})));
  std::uint64_t next = 0;
  drive_into(store, tasks, jobs, "read", [&](std::size_t index, const SeedResult& result) {
    EXPECT_EQ(index, next);
    EXPECT_EQ(result.seed, next);
    EXPECT_EQ(result.csv.size(), 97 * next);
    ++next;
  });
  EXPECT_EQ(next, count);
}

// Law: each result comes once, in the order of its task, whatever the number of threads.
// Mutations: threads that begin at the same task, or go on by one task too many; a last part left out.
TEST(KeptResults, ComeInOrderHoweverManyThreadsRead) {
  for (const auto& [count, jobs] : {std::pair{1U, 4}, {8U, 1}, {33U, 4}, {100U, 3}}) {
    SCOPED_TRACE(std::to_string(count) + " results, " + std::to_string(jobs) + " threads");
    expect_in_order(count, jobs);
  }
}

// A thread's complaint is the caller's, whichever thread has it. Mutation: futures that nobody asks.
TEST(KeptResults, AreNotHandedOnWhereOneCannotBeRead) {
  const TestFolder folder;
  AnswerStore store(folder.path() / kDrivesFile);
  std::vector<DriveTask> tasks;
  for (std::uint64_t seed = 0; seed < 8; ++seed)
    tasks.push_back(kept_task(store, seed, seed == 5 ? "no result" : to_bytes({.seed = seed})));
  int handed_on = 0;
  EXPECT_ANY_THROW(drive_into(store, tasks, 4, "read", [&](std::size_t, const SeedResult&) { ++handed_on; }));
  EXPECT_EQ(handed_on, 0);
}

}  // namespace
}  // namespace stereobench::harness
