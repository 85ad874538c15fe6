/// `compare`: what it says of two results, and its exit codes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

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

// A change of 5.05 % +- something lies on the margin of 5 %. Mutation: --strict read and forgotten.
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

// Law: the outcome does not depend on who is asked, or where. Mutation: paths in what is compared.
TEST_F(CompareCommand, SaysTheSameEachTime) {
  const Outcome once = compare(result(1.0), result(1.04));
  EXPECT_EQ(compare(result(1.0), result(1.04)).out, once.out);
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
