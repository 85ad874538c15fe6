#include "harness/shards/shard.h"

#include <cstdlib>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/complaint.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;

/// Sets a variable as long as it lives.
class SetVariable {
 public:
  SetVariable(const char* name, const char* value) : name_(name) { ::setenv(name, value, 1); }
  ~SetVariable() { ::unsetenv(name_); }
  SetVariable(const SetVariable&) = delete;
  SetVariable& operator=(const SetVariable&) = delete;

 private:
  const char* name_;
};

// Law: the shards of any count have each task once.
TEST(Shard, HasEachTaskOnce) {
  for (const std::size_t count : {1U, 2U, 3U, 7U})
    for (std::size_t task = 0; task < 20; ++task) {
      std::size_t owners = 0;
      for (std::size_t i = 1; i <= count; ++i)
        owners += parse_shard(std::to_string(i) + "/" + std::to_string(count)).has(task) ? 1U : 0U;
      EXPECT_EQ(owners, 1U);
    }
  EXPECT_EQ(parse_shard("0/3").number, 0U);
  for (const char* bad :
       {"0/0", "4/3", "1", "1/", "/3", "1/3x", "-1/3", "a/b", "", "auto", "auto/", "auto/0"})
    EXPECT_THROW(parse_shard(bad), std::runtime_error) << bad;
}

// Schedulers count from 0. Mutations: counted from 1; a variable that is out of range taken modulo.
TEST(Shard, IsTheOneThatTheSchedulerSays) {
  for (const char* name : {"SLURM_ARRAY_TASK_ID", "JOB_COMPLETION_INDEX"}) {
    const SetVariable first(name, "0");
    EXPECT_EQ(parse_shard("auto/40").number, 1U);
    const SetVariable last(name, "39");
    EXPECT_EQ(parse_shard("auto/40").in_words(), "40 of 40");
    EXPECT_EQ(parse_shard("2/3").number, 2U) << "said, so not looked up";
    for (const char* bad : {"40", "-1", "x", ""}) {
      const SetVariable beyond(name, bad);
      EXPECT_THAT(complaint_of([] { parse_shard("auto/40"); }),
                  HasSubstr(std::string("--shard: expected ") + name + " to be a number from 0 to 39"));
    }
  }
  EXPECT_THAT(complaint_of([] { parse_shard("auto/40"); }), HasSubstr("or say which shard it is"));
  const SetVariable slurm("SLURM_ARRAY_TASK_ID", "1");
  const SetVariable pod("JOB_COMPLETION_INDEX", "1");
  EXPECT_THAT(complaint_of([] { parse_shard("auto/40"); }), HasSubstr("not both"));
}

}  // namespace
}  // namespace stereobench::harness
