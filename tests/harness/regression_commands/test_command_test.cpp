/// `test` and `bless`: a baseline comes into being, holds, and is not written by anything else.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/harness/regression_commands/tiny_suite.h"

namespace stereobench::harness {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const char* const kField = "  - {name: field, scenario: field.yaml}\n";
const char* const kBaselineOfField = "tiny.baseline/field.json";

/// Makes all errors of the baseline smaller: what is tested looks worse.
void flatter(TinySuite& suite, double factor) {
  auto json = nlohmann::ordered_json::parse(bytes_of(suite.path(kBaselineOfField)));
  for (auto& value : json["per_seed"]["filters.iekf.ate_rms_m"]) value = factor * value.get<double>();
  suite.folder().write(kBaselineOfField, json.dump());
}

// Mutations: a missing baseline that passes; `test` that writes what is missing; a comparison of the means
// alone.
TEST(TestCommand, HoldsASuiteAgainstWhatWasBlessed) {
  TinySuite suite(kField);
  const Outcome first = suite.test();
  EXPECT_EQ(first.exit_code, 5) << first.err;
  EXPECT_THAT(first.out, AllOf(HasSubstr("NO BASELINE"), HasSubstr("stereobench bless")));
  EXPECT_FALSE(suite.has("tiny.baseline"));
  const Outcome blessed = suite.bless();
  EXPECT_EQ(blessed.exit_code, 0) << blessed.err;
  const std::string baseline = bytes_of(suite.path(kBaselineOfField));
  EXPECT_THAT(baseline, AllOf(HasSubstr("because it is good"), HasSubstr("\"filters.iekf.ate_rms_m\": [")));
  EXPECT_THAT(baseline, Not(HasSubstr(suite.path(""))));
  const Outcome second = suite.test();
  EXPECT_EQ(second.exit_code, 0) << second.out << second.err;
  flatter(suite, 0.5);
  const std::string flattered = bytes_of(suite.path(kBaselineOfField));
  const Outcome worse = suite.test({"--junit", suite.path("junit.xml"), "--markdown", suite.path("page.md")});
  EXPECT_EQ(worse.exit_code, 1);
  EXPECT_THAT(worse.out, AllOf(HasSubstr("REGRESSED"), HasSubstr("filters.iekf.ate_rms_m")));
  EXPECT_THAT(bytes_of(suite.path("junit.xml")),
              AllOf(HasSubstr("classname=\"tiny.field\""), HasSubstr("type=\"REGRESSED\"")));
  EXPECT_THAT(bytes_of(suite.path("page.md")), HasSubstr("| filters.iekf.ate_rms_m | REGRESSED"));
  EXPECT_EQ(bytes_of(suite.path(kBaselineOfField)), flattered);
  flatter(suite, 4.0);
  EXPECT_EQ(suite.test().exit_code, 0);
  EXPECT_EQ(suite.test({"--strict"}).exit_code, 6);
}

// A baseline knows where each ball was found: the page has both.
// Mutation: a page without the findings of the baseline.
TEST(TestCommand, ShowsFramesAsTheyWereAndAsTheyAre) {
  TinySuite suite("  - {name: room, scenario: room.yaml}\n");
  suite.test();
  suite.bless();
  const std::string file = "tiny.baseline/room.balls.csv";
  std::string csv = bytes_of(suite.path(file));
  const std::size_t line = csv.find("\n0,1,");
  csv.replace(line, csv.find('\n', line + 1) - line, "\n0,1,0,1,1,,0.0000000,0.5,0.0,0.0,0.0");
  suite.folder().write(file, csv);
  suite.test();
  EXPECT_THAT(bytes_of(suite.path("out/report.html")),
              AllOf(HasSubstr("The frames that changed most"), HasSubstr("seed 0, frame 1"),
                    HasSubstr("A, left camera (picture of B)"), HasSubstr("--frame 0:1")));
}

// A detector that finds nothing any more: five pairs of each of two seeds change, and of the second seed a
// run keeps four. Each is shown. It is said which is A, and the cause stands before the table. Mutations:
// pictures of kept pairs alone; the table first.
TEST(TestCommand, ShowsPicturesOfAllFramesThatChangedMost) {
  TinySuite suite("  - {name: room, scenario: room.yaml, set: [path.laps=0.14]}\n");
  suite.test();
  suite.bless();
  suite.folder().write("blind.py", R"(
import json, sys
sys.stdin.readline()
for line in sys.stdin:
    print(json.dumps({"frame": json.loads(line)["frame"], "balls": []}), flush=True)
)");
  const Outcome worse = suite.test({"--detector", "python3 '" + suite.path("blind.py") + "'"});
  EXPECT_EQ(worse.exit_code, 1) << worse.err;
  EXPECT_THAT(bytes_of(suite.path("out/report.html")),
              AllOf(HasSubstr("The frames that changed most"), Not(HasSubstr("\"picture\":null"))));
  const std::size_t names = worse.out.find("A is the baseline, B is now");
  const std::size_t cause = worse.out.find("balls that had to be found, A alone found");
  EXPECT_LT(names, cause);
  EXPECT_LT(cause, worse.out.find("vision.recall"));
}

// Mutations: hashes of inputs that are not compared; seeds or filters among the inputs.
TEST(TestCommand, DoesNotCompareWhatIsOfOtherInputs) {
  TinySuite suite(kField);
  suite.test();
  suite.bless();
  std::string other = TinySuite::field();
  other.replace(other.find("range_sd_m: 0.05"), 16, "range_sd_m: 0.06");
  suite.folder().write("field.yaml", other);
  const Outcome outcome = suite.test();
  EXPECT_EQ(outcome.exit_code, 5);
  EXPECT_THAT(outcome.out, HasSubstr("is of another scenario"));
  suite.folder().write("field.yaml", "# a comment\n" + TinySuite::field());
  EXPECT_EQ(suite.test().exit_code, 0);
  suite.folder().write("tiny.yaml",
                       "suite: tiny\ncases:\n  - {name: field, scenario: field.yaml, seeds: 3..7}\n");
  EXPECT_EQ(suite.test().exit_code, 0);
}

// Mutations: each refusal of `check` left out.
TEST(BlessCommand, RefusesWhatIsNoBaseline) {
  TinySuite suite(kField);
  EXPECT_THAT(suite.bless().err, HasSubstr("places.json"));
  suite.test({"--seeds", "0..1"});
  const Outcome partial = suite.bless();
  EXPECT_EQ(partial.exit_code, 2);
  EXPECT_THAT(partial.err, HasSubstr("8 of the 10 seeds that the suite asks for were not run"));
  suite.test();
  EXPECT_EQ(run_stereobench({"bless", suite.path("out")}).exit_code, 2);
  EXPECT_THAT(suite.bless({"--only", "nothing"}).err, HasSubstr("--only"));
  EXPECT_EQ(suite.bless().exit_code, 0);
  flatter(suite, 0.97);
  suite.test();
  const Outcome undecided = suite.bless();
  EXPECT_EQ(undecided.exit_code, 0) << "a change of 3 % on each seed lies within the margin of 5 %";
  std::filesystem::remove(suite.path("out/test.json"));
  EXPECT_THAT(suite.bless().err, HasSubstr("did not end"));
}

TEST(BlessCommand, RefusesAResultThatIsNotDecided) {
  TinySuite suite(kField);
  suite.test();
  suite.bless();
  auto json = nlohmann::ordered_json::parse(bytes_of(suite.path(kBaselineOfField)));
  auto& errors = json["per_seed"]["filters.iekf.ate_rms_m"];
  errors[3] = 10.0 * errors[3].get<double>();
  const std::string odd = json.dump();
  suite.folder().write(kBaselineOfField, odd);
  EXPECT_EQ(suite.test().exit_code, 0);
  EXPECT_EQ(suite.test({"--strict"}).exit_code, 3);
  const Outcome refused = suite.bless();
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("inconclusive"));
  EXPECT_EQ(bytes_of(suite.path(kBaselineOfField)), odd);
  EXPECT_EQ(suite.bless({"--undecided"}).exit_code, 0);
  EXPECT_EQ(suite.test({"--strict"}).exit_code, 0);
}

// Nothing of the user's is deleted, whatever cases are called. Mutation: folders of golden pictures that have
// the names of cases, and are removed whole.
TEST(BlessCommand, LeavesOtherFilesAlone) {
  TinySuite suite("  - {name: docs, scenario: field.yaml}\n");
  suite.folder().write("docs/thesis.txt", "years");
  suite.folder().write("docs.golden/notes.txt", "days");
  suite.test();
  EXPECT_EQ(suite.bless({"--baseline", suite.path("")}).exit_code, 0);
  EXPECT_EQ(bytes_of(suite.path("docs/thesis.txt")), "years");
  EXPECT_EQ(bytes_of(suite.path("docs.golden/notes.txt")), "days");
}

// Mutation: the whole folder of a case that broke down is removed.
TEST(TestCommand, DeletesResultsAloneWhereACaseBreaksDown) {
  TinySuite suite("  - {name: docs, scenario: room.yaml, detector: 'false'}\n");
  suite.folder().write("out/docs/thesis.txt", "years");
  suite.folder().write("out/docs/golden/notes.txt", "days");
  suite.folder().write("out/docs/report.html", "of an earlier test");
  EXPECT_EQ(suite.test().exit_code, 4);
  EXPECT_EQ(bytes_of(suite.path("out/docs/thesis.txt")), "years");
  EXPECT_EQ(bytes_of(suite.path("out/docs/golden/notes.txt")), "days");
  EXPECT_FALSE(suite.has("out/docs/report.html"));
}

// Mutation: the worst verdict alone decides.
TEST(BlessCommand, RefusesABrokenGateBesideARegression) {
  TinySuite suite("  - {name: field, scenario: field.yaml}\n");
  suite.test();
  suite.bless();
  flatter(suite, 0.5);
  suite.folder().write("tiny.yaml",
                       "suite: tiny\ncases:\n  - {name: field, scenario: field.yaml, gates: [{metric: "
                       "filters.iekf.failures, at_least: 1}]}\n");
  EXPECT_THAT(suite.test().out, HasSubstr("field: REGRESSED"));
  EXPECT_THAT(suite.bless().err, HasSubstr("a gate is broken"));
}

// Mutations: seeds without a baseline that are left out silently; patterns that fit nothing.
TEST(TestCommand, DoesNotPassWhatItDidNotCompare) {
  TinySuite suite("  - {name: field, scenario: field.yaml, seeds: 0..4}\n");
  suite.test();
  suite.bless();
  suite.folder().write("tiny.yaml",
                       "suite: tiny\ncases:\n  - {name: field, scenario: field.yaml, seeds: 4..13}\n");
  const Outcome other = suite.test();
  EXPECT_EQ(other.exit_code, 5);
  EXPECT_THAT(other.out, HasSubstr("field.json lacks 9 of 10 seeds"));
  suite.folder().write(
      "tiny.yaml",
      "suite: tiny\ncases:\n  - {name: field, scenario: field.yaml, metrics: [filters.*.ate_rsm_m]}\n");
  EXPECT_THAT(suite.test().err, HasSubstr("no metric of the case fits 'filters.*.ate_rsm_m'"));
}

// Mutation: few seeds without a word.
TEST(TestCommand, SaysThatFewSeedsCannotTell) {
  TinySuite suite("  - {name: field, scenario: field.yaml, seeds: 0..4}\n");
  suite.test();
  suite.bless();
  flatter(suite, 0.01);
  const Outcome outcome = suite.test();
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("warning: 5 seeds cannot tell"));
}

TEST(BlessCommand, RefusesABrokenGate) {
  TinySuite suite(
      "  - {name: field, scenario: field.yaml, gates: [{metric: filters.iekf.failures, at_least: 1}]}\n");
  const Outcome outcome = suite.test();
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("gate broken: filters.iekf.failures is 0"));
  EXPECT_THAT(suite.bless().err, HasSubstr("a gate is broken"));
}

// A blessing without a change is none: version control shows no difference.
TEST(BlessCommand, LeavesEqualBaselinesAlone) {
  TinySuite suite(kField);
  suite.test();
  suite.bless();
  const std::string before = bytes_of(suite.path(kBaselineOfField));
  suite.test();
  const Outcome again = run_stereobench({"bless", suite.path("out"), "--reason", "another reason"});
  EXPECT_THAT(again.out, HasSubstr("unchanged"));
  EXPECT_EQ(bytes_of(suite.path(kBaselineOfField)), before);
}

// Mutation: a loop that stops at the first look.
TEST(TestCommand, RunsSeedsUntilTheyDecide) {
  TinySuite suite("  - {name: field, scenario: field.yaml, seeds: 0..39, metrics: [filters.*.ate_rms_m]}\n");
  suite.test();
  suite.bless();
  const Outcome equal = suite.test({"--until-decided"});
  EXPECT_EQ(equal.exit_code, 0);
  EXPECT_EQ(nlohmann::json::parse(bytes_of(suite.path("out/test.json")))["cases"][0]["looks"].size(), 1u);
  auto json = nlohmann::ordered_json::parse(bytes_of(suite.path(kBaselineOfField)));
  auto& errors = json["per_seed"]["filters.iekf.ate_rms_m"];
  for (std::size_t i = 0; i < errors.size(); i += 2) errors[i] = 2.0 * errors[i].get<double>();
  for (std::size_t i = 1; i < errors.size(); i += 2) errors[i] = 0.5 * errors[i].get<double>();
  suite.folder().write(kBaselineOfField, json.dump());
  const Outcome odd = suite.test({"--until-decided", "--max-seeds", "20"});
  EXPECT_THAT(odd.out, AllOf(HasSubstr("look at 10 seeds, alpha 0.005: 1 inconclusive"),
                             HasSubstr("look at 20 seeds, alpha 0.005: 1 inconclusive")));
}

// A seed of all cases: one drive, and results as without the others. Mutation: a key of pictures with the
// filters in it (the test of shared pictures is red, not this one); a late detector's looks told to all.
TEST(TestCommand, CasesGiveTheSameAsIfTheyWereAlone) {
  const std::string cases =
      "  - {name: one, scenario: room.yaml}\n"
      "  - {name: two, scenario: room.yaml, filters: [smoother], set: [odometry_noise.v_constant_mps=0.1]}\n"
      "  - {name: late, scenario: room.yaml, set: ['detector_noise={latency_frames: 1, centre_sd_px: "
      "0.3}']}\n";
  TinySuite suite(cases);
  suite.test();
  for (const std::string name : {"two", "late"}) {
    const std::string results = suite.path("out/" + name + "/run.json");
    const std::string together = bytes_of(results);
    suite.test({"--only", name, "--jobs", "1"});
    EXPECT_EQ(bytes_of(results), together) << name;
  }
}

}  // namespace
}  // namespace stereobench::harness
