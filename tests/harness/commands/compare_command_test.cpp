/// `compare`: what it says of two results, and its exit codes.
#include <cstdlib>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "harness/vision_scoring/detection_table.h"
#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

/// A result of ten seeds whose errors are a multiple of 1.0, 1.1, ...
std::string result(double factor, const std::string& more = "") {
  nlohmann::json errors, seeds;
  for (int seed = 0; seed < 10; ++seed) {
    seeds.push_back(seed);
    errors.push_back(factor * (1.0 + 0.1 * seed));
  }
  return R"({"schema": 1, "scenario": "office", "seeds": )" + seeds.dump() +
         R"(, "per_seed": {"filters.ekf.ate_rms_m": )" + errors.dump() + more + "}}";
}

class CompareCommand : public testing::Test {
 protected:
  Outcome compare(const std::string& first, const std::string& second,
                  const std::vector<std::string>& more = {}) {
    folder_.write("a/run.json", first);
    folder_.write("b/run.json", second);
    return run_stereobench(with({"compare", path("a"), path("b")}, more));
  }
  std::string path(const std::string& name) { return (folder_.path() / name).string(); }

  TestFolder folder_;
};

// Mutations: 0 for a regression; 1 for an improvement.
TEST_F(CompareCommand, ExitsWithOneWhereAMetricGotWorse) {
  EXPECT_EQ(compare(result(1.0), result(1.0)).exit_code, 0);
  const Outcome worse = compare(result(1.0), result(1.2));
  EXPECT_EQ(worse.exit_code, 1);
  EXPECT_THAT(worse.out, AllOf(HasSubstr("REGRESSED"), HasSubstr("filters.ekf.ate_rms_m"), HasSubstr("+20"),
                               HasSubstr("1 metric compared on 10 seeds: 1 REGRESSED; 1 of them changed")));
  EXPECT_EQ(compare(result(1.2), result(1.0)).exit_code, 0);
}

// Mutation: --strict read and forgotten.
TEST_F(CompareCommand, IsStrictWhereItIsToldTo) {
  const std::vector<std::string> wide = {"--margin", "filters.*=1000%"};
  EXPECT_EQ(compare(result(1.0), result(1.2), with({"--strict"}, wide)).exit_code, 0);
  EXPECT_EQ(compare(result(1.2), result(1.0), {"--strict"}).exit_code, 6);
  const std::string odd = R"({"schema": 1, "scenario": "office", "seeds": [0, 1, 2], "per_seed": )";
  const std::string one = odd + R"({"filters.ekf.ate_rms_m": [1, 2, 3]}})";
  const std::string other = odd + R"({"filters.ekf.ate_rms_m": [1, 2.5, 2.8]}})";
  EXPECT_EQ(compare(one, other).exit_code, 0);
  EXPECT_EQ(compare(one, other, {"--strict"}).exit_code, 3);
  EXPECT_THAT(compare(one, other).out, HasSubstr("INCONCLUSIVE"));
}

TEST_F(CompareCommand, ReportsWhatVanished) {
  const std::string more = R"(, "vision.recall": [1, 1, 1, 1, 1, 1, 1, 1, 1, 1])";
  const Outcome outcome = compare(result(1.0, more), result(1.0));
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("VANISHED"), HasSubstr("vision.recall")));
  EXPECT_EQ(compare(result(1.0), result(1.0, more)).exit_code, 0);
}

TEST_F(CompareCommand, WritesItsVerdictsForProgramsAndForPullRequests) {
  compare(result(1.0), result(1.2), {"--json", path("out.json"), "--markdown", path("out.md")});
  const auto json = nlohmann::json::parse(bytes_of(path("out.json")));
  EXPECT_EQ(json["metrics"][0]["verdict"], "REGRESSED");
  EXPECT_NEAR(json["metrics"][0]["worse_by"].get<double>(), 0.29, 1e-9);
  EXPECT_THAT(bytes_of(path("out.md")), HasSubstr("| filters.ekf.ate_rms_m | REGRESSED"));
}

// Read by another program's parser. Mutations: an inconclusive metric that fails; a name without its escapes.
TEST_F(CompareCommand, WritesJunitsXml) {
  const std::string more = R"(, "filters.<&>.ate_rms_m": [1, 2, 3, 4, 5, 6, 7, 8, 9, 10])";
  const std::string other = R"(, "filters.<&>.ate_rms_m": [1, 2, 3, 4, 5, 6, 7, 8, 9, 12])";
  compare(result(1.0, more), result(1.2, other), {"--junit", path("out.xml")});
  std::ofstream(path("read.py")) << R"(
import sys, xml.etree.ElementTree as tree
suite = tree.parse(sys.argv[1]).getroot().find("testsuite")
assert suite.attrib == dict(name="compare.office", tests="2", failures="1", errors="0", skipped="1"), suite.attrib
failed, skipped = suite.findall("testcase")
assert failed.get("name") == "filters.ekf.ate_rms_m" and failed.find("failure").get("type") == "REGRESSED"
assert "worse by +20" in failed.find("failure").text, failed.find("failure").text
assert skipped.get("name") == "filters.<&>.ate_rms_m" and skipped.find("skipped") is not None
)";
  EXPECT_EQ(std::system(("/usr/bin/python3 '" + path("read.py") + "' '" + path("out.xml") + "'").c_str()), 0)
      << bytes_of(path("out.xml"));
}

TEST_F(CompareCommand, SaysTheSameEachTime) {
  const Outcome once = compare(result(1.0), result(1.04));
  EXPECT_EQ(compare(result(1.0), result(1.04)).out, once.out);
}

// Mutation: nobody hears of it.
TEST_F(CompareCommand, SaysWhatGotWorseWhenItIsQuietToo) {
  EXPECT_THAT(compare(result(1.0), result(1.2), {"--quiet"}).err, HasSubstr("REGRESSED"));
  const Outcome better = compare(result(1.2), result(1.0), {"--quiet"});
  EXPECT_EQ(better.out + better.err, "");
}

// 5 seeds: 2 / 2^5 is above 1 %. Mutation: no word of it.
TEST_F(CompareCommand, WarnsOfTooFewSeeds) {
  const std::string few =
      R"({"schema": 1, "scenario": "x", "seeds": [0, 1, 2, 3, 4], "per_seed": {"filters.ekf.ate_rms_m": )";
  const Outcome outcome = compare(few + "[1, 2, 3, 4, 5]}}", few + "[10, 21, 32, 43, 54]}}");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out,
              HasSubstr("warning: 5 seeds cannot tell 1 changed metric from chance (alpha 0.01): 8"));
}

/// A table of ten seeds with one ball each.
std::string detections(const std::string& outcome, const std::string& colour) {
  std::string rows = detections_csv_header();
  for (int seed = 0; seed < 10; ++seed)
    rows += std::to_string(seed) + ",0," + outcome + ",0,1,3,2,0.1,100,100,90,100,12,1,1,50," + colour +
            (outcome == "miss" ? ",,,,,,,,," : ",2,0.1,1e-6,0,1e-6,100,100,90,100") + "\n";
  return rows;
}

// Mutations: tables that are not read; counts of the wrong metric.
TEST_F(CompareCommand, SaysWhichBallsWereLost) {
  const auto rates = [](const std::string& recall, const std::string& wrong) {
    const std::string ten =
        ", \"vision.recall\": [" + recall + "], \"vision.misidentified\": [" + wrong + "]";
    return result(1.0, ten);
  };
  const std::string ones = "1,1,1,1,1,1,1,1,1,1", noughts = "0,0,0,0,0,0,0,0,0,0";
  folder_.write("a/detections.csv.gz", detections("true_positive", "3"));
  folder_.write("b/detections.csv.gz", detections("miss", ""));
  folder_.write("b/invocation.json", "{}");
  const Outcome lost = compare(rates(ones, noughts), rates(noughts, noughts), {"--json", path("out.json")});
  EXPECT_EQ(lost.exit_code, 1);
  EXPECT_THAT(lost.out, AllOf(HasSubstr("of 10 balls that had to be found, A alone found 10 and B alone 0"),
                              HasSubstr("stereobench replay " + path("b") + " --frame 0:0\n")));
  const auto json = nlohmann::json::parse(bytes_of(path("out.json")));
  EXPECT_EQ(json["metrics"][0]["test"], "mcnemar");
  EXPECT_EQ(json["detections"]["found_by_first_alone"], 10);
  folder_.write("b/detections.csv.gz", detections("wrong_identity", "7"));
  const Outcome wrong = compare(rates(ones, noughts), rates(noughts, ones));
  EXPECT_THAT(wrong.out,
              AllOf(HasSubstr("B alone took 10 balls for another colour"),
                    HasSubstr("colour 3 taken for 7: 10"), HasSubstr("vision.misidentified  REGRESSED")));
}

TEST_F(CompareCommand, RefusesWhatIsNoResult) {
  const auto refused = [&](const std::string& second, const std::string& line) {
    const Outcome outcome = compare(result(1.0), second);
    EXPECT_EQ(outcome.exit_code, 2) << line;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr(path("b/run.json")), HasSubstr(line)));
    EXPECT_THAT(outcome.out, IsEmpty());
  };
  refused("{", "expected a line of JSON");
  refused("[]", "expected an object");
  refused(R"({"schema": 2})", "schema: expected 1 (got 2)");
  refused(R"({"schema": 1, "scenario": "x", "seeds": []})", "seeds: expected a list");
  refused(R"({"schema": 1, "scenario": "x", "seeds": [3, 3]})", "seeds: expected each seed once");
  refused(R"({"schema": 1, "scenario": "x", "seeds": [3]})", "which older versions did not write");
  refused(R"({"schema": 1, "scenario": "x", "seeds": [3], "per_seed": {"vision.recall": [1, 2]}})",
          "per_seed.vision.recall: expected a list of 1 entries (got 2)");
  refused(R"({"schema": 1, "scenario": "x", "seeds": [3], "per_seed": {"vision.recall": ["a"]}})",
          "per_seed.vision.recall[0]: expected a number");
  const Outcome missing = run_stereobench({"compare", path("a"), path("nowhere")});
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_THAT(missing.err, HasSubstr("nowhere: no such file"));
  const Outcome unfinished = run_stereobench({"compare", folder_.path().string(), path("a")});
  EXPECT_EQ(unfinished.exit_code, 2);
  EXPECT_THAT(unfinished.err, HasSubstr("expected a folder with a run.json"));
}

// The same code twice is the same bytes, whatever the number of jobs; another odometry is worse.
TEST_F(CompareCommand, OfRunsOfTheSameCodePasses) {
  const auto run = [&](const std::string& out, const std::vector<std::string>& more) {
    EXPECT_EQ(
        run_stereobench(with({"run", scenario_path("open_field"), "--seeds", "0..11", "--filters",
                              "fastslam2", "--particles", "20", "--set", "gates=[]", "--out", path(out)},
                             more))
            .exit_code,
        0);
  };
  run("one", {"--jobs", "1"});
  run("two", {"--jobs", "3"});
  run("noisy", {"--set", "oracle.range_sd_m=1"});
  const Outcome same = run_stereobench({"compare", path("one"), path("two"), "--strict"});
  EXPECT_EQ(same.exit_code, 0) << same.out << same.err;
  EXPECT_THAT(same.out, HasSubstr("0 of them changed"));
  const Outcome worse = run_stereobench({"compare", path("one"), path("noisy"), "--only", "filters.*rms*"});
  EXPECT_EQ(worse.exit_code, 1) << worse.out;
}

}  // namespace
}  // namespace stereobench::harness
