#include "harness/suite/suite_report.h"

#include <gtest/gtest.h>

namespace stereobench::harness {
namespace {

// A first test has nothing to compare with: it says what was found, what to do, and what is not enough for a
// baseline. Mutation: what was measured is said only beside a comparison.
TEST(SuiteReport, OfACaseWithoutBaselineSaysWhatWasFound) {
  CaseReport report;
  report.name = "plain";
  report.not_compared = "there is no baseline";
  report.measured = "found 23 of 25 balls";
  report.partial = "19 of the 20 seeds were not run";
  EXPECT_EQ(remarks(report),
            "there is no baseline\nnow: found 23 of 25 balls\n"
            "partial: 19 of the 20 seeds were not run; bless refuses such a result\n");
  report.not_compared = "";
  report.partial = "";
  EXPECT_EQ(remarks(report), "");
}

}  // namespace
}  // namespace stereobench::harness
