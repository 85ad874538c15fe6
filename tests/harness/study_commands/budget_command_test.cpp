/// `stereobench budget` as its users run it.
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const std::vector<std::string> kQuestion = {"--set",    "path.laps=0.2",
                                            "--set",    "rig.width_px=512",
                                            "--set",    "rig.height_px=384",
                                            "--set",    "rig.focal_px=443",
                                            "--metric", "filters.ekf.ate_rms_m",
                                            "--limit",  "0.01",
                                            "--share",  "0.7",
                                            "--seeds",  "0..8"};

std::vector<std::string> budget_of(const std::vector<std::string>& ranges) {
  std::vector<std::string> words = {"budget", scenario_path("ball_circle")};
  for (const std::string& range : ranges) words.insert(words.end(), {"--vary", range});
  return with(words, kQuestion);
}

json result_in(const std::filesystem::path& out) {
  return json::parse(bytes_of(out / "budget.json"));
}

// The budget is where runs say that it is: at its level no seed breaks the limit, and at the next one a seed
// does. Mutations: a level of another seed; the metric of another filter.
TEST(BudgetCommand, IsTheLevelUpToWhichRunsKeepTheLimit) {
  const TestFolder scratch;
  const Outcome outcome = run_stereobench(
      with(budget_of({"detector_noise.centre_sd_px=0..4"}), {"--out", (scratch.path() / "b").string()}));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json answer = result_in(scratch.path() / "b")["budgets"][0];
  ASSERT_EQ(answer["outcome"], "found") << answer.dump();
  EXPECT_THAT(outcome.out, HasSubstr("detector_noise.centre_sd_px may be up to"));
  const auto worst_at = [&](const json& level) {
    const auto out = scratch.path() / "run";
    std::filesystem::remove_all(out);
    std::vector<std::string> words = {"run", scenario_path("ball_circle"), "--out", out.string(), "--filters",
                                      "ekf"};
    for (std::size_t i = 0; i < 8; ++i) words.push_back(kQuestion[i]);
    words.insert(words.end(), {"--seeds", "0..8", "--set", "gates=[]", "--set",
                               "detector_noise.centre_sd_px=" + level.dump()});
    EXPECT_EQ(run_stereobench(words).exit_code, 0);
    return json::parse(bytes_of(out / "run.json"))["filters"]["ekf"]["ate_rms_m"]["max"].get<double>();
  };
  EXPECT_LE(worst_at(answer["level"]), 0.01);
  EXPECT_GT(worst_at(answer["fails_at"]), 0.01);
}

// Mutation: chunks by the number of jobs.
TEST(BudgetCommand, SameBytesForAnyNumberOfJobs) {
  const TestFolder scratch;
  for (const char* jobs : {"1", "3"})
    ASSERT_EQ(run_stereobench(with(budget_of({"detector_noise.miss_probability=0..1"}),
                                   {"--jobs", jobs, "--out", (scratch.path() / jobs).string()}))
                  .exit_code,
              0);
  for (const char* file : {"budget.json", "budget.png"})
    EXPECT_EQ(bytes_of(scratch.path() / "1" / file), bytes_of(scratch.path() / "3" / file)) << file;
}

// Several lines: each for itself, and all by the same fraction. Mutation: no mix.
TEST(BudgetCommand, OfSeveralLinesIsOfEachAndOfAll) {
  const TestFolder scratch;
  const Outcome outcome = run_stereobench(
      with(budget_of({"detector_noise.centre_sd_px=0..4", "detector_noise.range_scale=1..1.2"}),
           {"--out", (scratch.path() / "b").string(), "--tolerance", "0.2"}));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json answers = result_in(scratch.path() / "b")["budgets"];
  ASSERT_EQ(answers.size(), 3U);
  EXPECT_LE(answers[2]["level"].get<double>(), 1.0);
}

// Anybody's detector, which is asked about each pair once, however many levels are tried. Mutations: a look
// for each level; a look of the first seeds alone.
TEST(BudgetCommand, AsksADetectorsProgramOnce) {
  const TestFolder scratch;
  const auto frames = scratch.path() / "frames";
  // The file of frames is not named in the command: what is named there is hashed, and it grows.
  const auto script = scratch.write("nothing.py", R"(import json, os, sys
frames = open(os.path.join(os.path.dirname(sys.argv[0]), "frames"), "a")
sys.stdin.readline()
for line in sys.stdin:
    frames.write(".")
    frames.flush()
    print(json.dumps({"frame": json.loads(line)["frame"], "balls": []}), flush=True)
)");
  const std::string detector = "/usr/bin/python3 '" + script.string() + "'";
  const auto frames_of = [&](const std::vector<std::string>& words) {
    std::filesystem::remove(frames);
    const Outcome outcome = run_stereobench(
        with(words, {"--out", (scratch.path() / words.front()).string(), "--detector", detector}));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return bytes_of(frames).size();
  };
  std::vector<std::string> run = {"run", scenario_path("ball_circle"), "--set", "gates=[]", "--seeds",
                                  "0..8"};
  run.insert(run.end(), kQuestion.begin(), kQuestion.begin() + 8);
  const std::size_t pairs = frames_of(run);
  EXPECT_GT(pairs, 9U);
  EXPECT_EQ(frames_of(budget_of({"detector_noise.false_per_frame=0..5"})), pairs);
}

TEST(BudgetCommand, RefusesInOneLine) {
  const auto complaint = [](const std::vector<std::string>& arguments) {
    const Outcome outcome = run_stereobench(with(arguments, {"--dry-run"}));
    EXPECT_EQ(outcome.exit_code, 2);
    return outcome.err;
  };
  EXPECT_THAT(complaint(with(budget_of({"particles=9..1"}), {"--confidence", "0.999"})),
              HasSubstr("--seeds: "));
  EXPECT_THAT(complaint(budget_of({"particles=9"})), HasSubstr("--vary: "));
  EXPECT_THAT(complaint(budget_of({"particle=9..1"})), HasSubstr("particles"));
  EXPECT_THAT(complaint(budget_of({"particles=9..1", "particles=8..1"})),
              HasSubstr("particles is varied twice"));
  EXPECT_THAT(complaint({"budget", scenario_path("open_field"), "--vary", "particles=9..1", "--metric",
                         "vision.recall", "--limit", "1"}),
              HasSubstr("the oracle has none"));
  EXPECT_THAT(complaint({"budget", scenario_path("ball_circle"), "--vary", "particles=9..1", "--metric",
                         "filters.ekf.ate_rms", "--limit", "1"}),
              HasSubstr("filters.ekf.ate_rms_m"));
  EXPECT_THAT(complaint({"budget", scenario_path("ball_circle"), "--vary", "particles=9..1", "--metric",
                         "filters.ekf.ate_rms_m"}),
              HasSubstr("--limit or --at-least"));
}

}  // namespace
}  // namespace stereobench::harness
