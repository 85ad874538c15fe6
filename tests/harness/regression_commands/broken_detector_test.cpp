/// Suites with a detector that breaks down in the middle: its case is an error, the others finish.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/harness/regression_commands/tiny_suite.h"

namespace stereobench::harness {
namespace {

using testing::AllOf;
using testing::HasSubstr;

struct BreakDown {
  std::string name;
  std::string at_frame_two;  ///< Python
  std::string says;          ///< part of the message
};
void PrintTo(const BreakDown& how, std::ostream* out) {
  *out << how.name;
}
class BrokenDetector : public testing::TestWithParam<BreakDown> {};

// Both cases see the same pictures, and so are driven together. Mutations: a fault that ends the pool; one
// that is put down to all that were driven with it; an error that does not hinder bless.
TEST_P(BrokenDetector, SpoilsItsOwnCaseAlone) {
  TinySuite suite("");
  suite.folder().write("detector.py", R"(
import json, sys, time
sys.stdin.readline()
for line in sys.stdin:
    frame = json.loads(line)["frame"]
    if frame == 2:
        )" + GetParam().at_frame_two + R"(
    print(json.dumps({"frame": frame, "balls": []}), flush=True)
)");
  suite.folder().write("tiny.yaml",
                       "suite: tiny\ncases:\n"
                       "  - {name: good, scenario: room.yaml}\n"
                       "  - {name: bad, scenario: room.yaml, detector_timeout_s: 1, detector: python3 '" +
                           suite.path("detector.py") +
                           "'}\n"
                           "  - {name: field, scenario: field.yaml}\n");
  const Outcome outcome = suite.test({"--junit", suite.path("junit.xml")});
  EXPECT_EQ(outcome.exit_code, 4) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr(GetParam().says)) << "told at once";
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("bad: ERROR"), HasSubstr(GetParam().says)));
  EXPECT_THAT(bytes_of(suite.path("junit.xml")), HasSubstr("<error type=\"ERROR\""));
  EXPECT_TRUE(suite.has("out/good/run.json"));
  EXPECT_TRUE(suite.has("out/field/run.json"));
  EXPECT_FALSE(suite.has("out/bad/run.json"));
  const Outcome blessed = suite.bless();
  EXPECT_EQ(blessed.exit_code, 2);
  EXPECT_THAT(blessed.err, HasSubstr("case bad: it broke down"));
  EXPECT_FALSE(suite.has("tiny.baseline"));
  EXPECT_EQ(suite.bless({"--only", "good"}).exit_code, 0);
}

INSTANTIATE_TEST_SUITE_P(All, BrokenDetector,
                         testing::Values(BreakDown{"Crashes", "sys.exit(3)", "frame 2"},
                                         BreakDown{"Hangs", "time.sleep(1000)", "frame 2"},
                                         BreakDown{"AnswersRubbish", "print('[' * 1000, flush=True)",
                                                   "frame 2"}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace stereobench::harness
