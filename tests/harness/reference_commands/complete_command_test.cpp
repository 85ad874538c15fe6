// The hidden command that shells call.
#include <gmock/gmock.h>

#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::Not;

// Meant to catch: no blank behind whole words; descriptions left out; the words without the first one.
TEST(CompleteCommand, PrintsAWordALine) {
  const Outcome whole = run_stereobench({"complete", "--", "run", "a.yaml", "--filters", "smoo"});
  EXPECT_EQ(whole.exit_code, 0) << whole.err;
  EXPECT_EQ(whole.out, "smoother \tincremental smoothing\n");
  EXPECT_EQ(run_stereobench({"complete", "--", "run", "--set", "camera.noise_sd"}).out.substr(0, 23),
            "camera.noise_sd_levels=");
}

// Meant to catch: found by the command line's reader, and listed; a command of its own that is advised.
TEST(CompleteCommand, IsHidden) {
  EXPECT_THAT(run_stereobench({"--help"}).out, Not(HasSubstr("complete")));
  EXPECT_EQ(run_stereobench({"complete", "--", "comple"}).out, "");
}

TEST(CompleteCommand, RefusesWordsWithoutTheMark) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{"complete"}, {"complete", "run"}}) {
    const Outcome outcome = run_stereobench(words);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.err,
              "stereobench: complete: expected '--' and the words of a command line; shells call this\n");
  }
  EXPECT_EQ(run_stereobench({"complete", "--"}).out, "") << "no word is being written";
}

}  // namespace
}  // namespace stereobench::harness
