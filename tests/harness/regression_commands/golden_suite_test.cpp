/// Golden pictures of a suite: kept by `bless`, compared by `test`.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/harness/regression_commands/tiny_suite.h"

namespace stereobench::harness {
namespace {

using testing::AllOf;
using testing::HasSubstr;

namespace fs = std::filesystem;

// Mutations: a picture that has changed and passes; `bless` without pictures; pictures that are not compared.
TEST(GoldenSuite, SaysWhatPictureChanged) {
  TinySuite suite("  - {name: room, scenario: room.yaml, golden: {frames: [0, 2]}}\n");
  EXPECT_EQ(suite.test().exit_code, 5);
  EXPECT_TRUE(suite.has("out/room/golden/seed0_step0000_left.png"));
  EXPECT_EQ(suite.bless().exit_code, 0);
  EXPECT_TRUE(suite.has("tiny.baseline/room.golden/seed0_step0002.json"));
  const Outcome same = suite.test();
  EXPECT_EQ(same.exit_code, 0) << same.out << same.err;
  const fs::path kept = suite.path("tiny.baseline/room.golden");
  for (const char* end : {".json", "_left.png", "_left_shown.png", "_right.png", "_right_shown.png"})
    fs::copy_file(kept / ("seed0_step0002" + std::string(end)), kept / ("seed0_step0000" + std::string(end)),
                  fs::copy_options::overwrite_existing);
  const Outcome changed = suite.test();
  EXPECT_EQ(changed.exit_code, 1);
  EXPECT_THAT(changed.out, AllOf(HasSubstr("room: PICTURE CHANGED"), HasSubstr("seed0_step0000: ")));
  EXPECT_EQ(suite.bless().exit_code, 0);
  EXPECT_EQ(suite.test().exit_code, 0);
  fs::remove(kept / "seed0_step0000.json");
  const Outcome missing = suite.test();
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_THAT(missing.out, HasSubstr("seed0_step0000.json"));
}

TEST(GoldenSuite, RefusesFramesThatThereAreNot) {
  EXPECT_THAT(TinySuite("  - {name: room, scenario: room.yaml, golden: {frames: [5000]}}\n").test().err,
              HasSubstr("case room: golden.frames: expected frames below"));
  EXPECT_THAT(TinySuite("  - {name: field, scenario: field.yaml, golden: {frames: [0]}}\n").test().err,
              HasSubstr("case field: golden: the sensor of the scenario is the oracle"));
  EXPECT_THAT(
      TinySuite("  - {name: room, scenario: room.yaml, golden: {frames: [0], limits: roundin}}\n").test().err,
      HasSubstr("rounding"));
}

// Mutation: bytes that are not compared.
TEST(CompareCommandWithItself, AsksForEqualBytes) {
  TinySuite suite("");
  const auto run = [&](const char* scenario, const char* out) {
    return run_stereobench({"run", suite.path(scenario), "--out", suite.path(out), "-q"}).exit_code;
  };
  ASSERT_EQ(run("room.yaml", "room"), 0);
  const Outcome equal = run_stereobench({"compare", suite.path("room"), "--self", "3"});
  EXPECT_EQ(equal.exit_code, 0) << equal.err;
  EXPECT_THAT(equal.out, HasSubstr("3 runs gave equal bytes"));
  suite.folder().write("room/steps.csv", bytes_of(suite.path("room/steps.csv")) + "\n");
  const Outcome other = run_stereobench({"compare", suite.path("room"), "--self", "2"});
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_THAT(other.out, HasSubstr("other bytes in steps.csv"));
  EXPECT_EQ(run_stereobench({"compare", suite.path("room")}).exit_code, 2);
}

}  // namespace
}  // namespace stereobench::harness
