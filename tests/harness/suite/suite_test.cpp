/// Suites as they are written, and how cases inherit.
#include "harness/suite/suite.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/complaint.h"
#include "tests/test_folder.h"

namespace stereobench::harness {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;

class SuiteFile : public testing::Test {
 protected:
  Suite read(const std::string& text) { return read_suite(folder_.write("suite.yaml", text)); }
  std::string complaint(const std::string& text) {
    return complaint_of([&] { read(text); });
  }

  TestFolder folder_;
};

// Mutations: a preset's list that is replaced by the case's; a preset that is not copied.
TEST_F(SuiteFile, CasesAreLikeTheirPresets) {
  const Suite suite = read(R"(
suite: vision
alpha: 0.05
presets:
  - {name: all, set: [a=1], seeds: 0..3, margins: [{metric: vision.*, percent: 2}]}
  - {name: small, like: all, set: [b=2], particles: 7}
cases:
  - {name: one, like: small, scenario: one.yaml, set: [c=3], margins: [{metric: vision.recall, change: 0.01}]}
  - {name: two, like: all, scenario: sub/two.yaml, seeds: 5, filters: [ekf], metrics: [vision.*],
     gates: [{metric: vision.recall, at_least: 0.9}], golden: {frames: [0, 3]}}
)");
  EXPECT_EQ(suite.name, "vision");
  EXPECT_EQ(suite.alpha, 0.05);
  ASSERT_EQ(suite.cases.size(), 2u);
  const SuiteCase& one = suite.cases[0];
  EXPECT_EQ(one.scenario, folder_.path() / "one.yaml");
  EXPECT_THAT(one.set, ElementsAre("a=1", "b=2", "c=3"));
  EXPECT_THAT(one.seeds, ElementsAre(0, 1, 2, 3));
  EXPECT_EQ(one.particles, 7);
  EXPECT_THAT(one.margins, ElementsAre(AllOf(Field(&Margin::pattern, "vision.*"),
                                             Field(&Margin::relative, true), Field(&Margin::value, 0.02)),
                                       AllOf(Field(&Margin::pattern, "vision.recall"),
                                             Field(&Margin::relative, false), Field(&Margin::value, 0.01))));
  const SuiteCase& two = suite.cases[1];
  EXPECT_EQ(two.scenario, folder_.path() / "sub" / "two.yaml");
  EXPECT_THAT(two.seeds, ElementsAre(5));
  EXPECT_THAT(two.filters, ElementsAre("ekf"));
  EXPECT_THAT(two.metrics, ElementsAre("vision.*"));
  EXPECT_EQ(two.particles, 0);
  EXPECT_THAT(two.golden.frames, ElementsAre(0, 3));
  ASSERT_EQ(two.gates.size(), 1u);
  EXPECT_EQ(two.gates[0].limit, 0.9);
}

// Mutations: presets that are looked up before they are read; names that may repeat.
TEST_F(SuiteFile, SaysWhatIsWrong) {
  EXPECT_THAT(complaint("suite: a\ncases:\n  - {name: one, scenari: x.yaml}\n"),
              AllOf(HasSubstr("suite.yaml:3"), HasSubstr("scenario")));
  EXPECT_THAT(complaint("suite: a\ncases:\n  - {name: one, like: b, scenario: x.yaml}\n"),
              HasSubstr("cases[0].like: expected the name of a preset"));
  EXPECT_THAT(complaint("suite: a\npresets:\n  - {name: b, like: c}\n  - {name: c}\n"
                        "cases:\n  - {name: one, scenario: x.yaml}\n"),
              HasSubstr("presets[0].like"));
  EXPECT_THAT(complaint("suite: a\ncases:\n  - {name: one}\n"), HasSubstr("expected `scenario:`"));
  EXPECT_THAT(complaint("suite: a\ncases:\n  - {name: one, scenario: x}\n  - {name: one, scenario: y}\n"),
              HasSubstr("cases[1].name"));
  EXPECT_THAT(complaint("suite: a\ncases:\n  - {name: ../one, scenario: x}\n"), HasSubstr("name"));
  EXPECT_THAT(complaint("suite: a\ncases:\n  - {name: one, scenario: x, seeds: 4..2}\n"), HasSubstr("seeds"));
  EXPECT_THAT(complaint("suite: a\ncases:\n  - {name: one, scenario: x, filters: [ekff]}\n"),
              HasSubstr("filters"));
}

TEST(UsualBaseline, LiesBesideTheSuite) {
  EXPECT_EQ(usual_baseline("a/b/quick.yaml"), "a/b/quick.baseline");
  EXPECT_EQ(usual_baseline("quick.yaml"), "quick.baseline");
}

}  // namespace
}  // namespace stereobench::harness
