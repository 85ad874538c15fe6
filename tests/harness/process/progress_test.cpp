#include "harness/process/progress.h"

#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace stereobench::harness {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// Work of 100 parts, one every few seconds of a clock of the test's own. @return what was written
std::vector<std::string> shown(bool is_terminal, std::chrono::milliseconds apart, int parts) {
  std::vector<std::string> written;
  ProgressOutput::Clock::time_point now(std::chrono::hours(5));
  const ProgressOutput output = {.is_terminal = is_terminal,
                                 .write = [&](const std::string& text) { written.push_back(text); },
                                 .now = [&] { return now; }};
  {
    Progress progress("run small", 100.0, output);
    for (int part = 1; part <= parts; ++part) {
      now += apart;
      progress.show(part);
    }
  }
  return written;
}

// Mutations: silence in a pipe; a line for each part; one at the start already.
TEST(Progress, InAPipeIsALineAMinute) {
  EXPECT_THAT(shown(false, std::chrono::seconds(5), 36),
              ElementsAre("run small: 12 %, 440 s left\n", "run small: 24 %, 380 s left\n",
                          "run small: 36 %, 320 s left\n"));
  EXPECT_THAT(shown(false, std::chrono::seconds(5), 11), IsEmpty());
  EXPECT_EQ(shown(false, std::chrono::seconds(90), 100).size(), 100U)
      << "parts that take longer than a minute";
}

// Mutations: lines that end, and scroll a terminal away; a line that stays behind.
TEST(Progress, OnATerminalIsOneLineRedrawn) {
  const auto written = shown(true, std::chrono::milliseconds(50), 100);
  EXPECT_EQ(written.size(), 51U) << "every other part, and the line is cleared in the end";
  for (const std::string& text : written) {
    EXPECT_THAT(text, HasSubstr("\r"));
    EXPECT_THAT(text, Not(HasSubstr("\n")));
  }
}

}  // namespace
}  // namespace stereobench::harness
