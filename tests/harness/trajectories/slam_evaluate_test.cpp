// `stereobench slam --evaluate`, the whole program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::Not;

class EvaluationCommand : public testing::Test {
 protected:
  EvaluationCommand() {
    std::string truth, estimate;
    for (int i = 0; i < 50; ++i) {
      const std::string time = std::to_string(100 + i);
      const std::string place = std::to_string(i) + " " + std::to_string(i % 7) + " " + std::to_string(i % 3);
      truth += time + ".000 " + place + " 0 0 0 1\n";
      estimate += time + ".002 " + place + (i == 20 ? ".5" : "") + " 0 0 0 1\n";
    }
    scratch_.write("truth.txt", truth);
    scratch_.write("estimate.txt", estimate);
  }

  Outcome evaluate(std::vector<std::string> more) const {
    std::vector<std::string> all = {"slam",  "--evaluate", path("estimate.txt"), "--truth", path("truth.txt"),
                                    "--out", path("out")};
    all.insert(all.end(), more.begin(), more.end());
    return run_stereobench(all);
  }
  std::string path(const std::string& name) const { return (scratch_.path() / name).string(); }

  const TestFolder scratch_;
};

TEST_F(EvaluationCommand, WritesWhatItPrints) {
  const Outcome outcome = evaluate({"--align", "none", "--delta", "5", "--segments-m", "10,20.5"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("estimate.txt: 50 poses, 50 of them paired with the 50 of truth.txt"));
  EXPECT_THAT(outcome.out, HasSubstr("RPE over 5 poses, translation [m]"));
  EXPECT_THAT(outcome.out, HasSubstr("pieces of"));
  const auto json = nlohmann::json::parse(bytes_of(scratch_.path() / "out/evaluation.json"));
  EXPECT_DOUBLE_EQ(json["ape"]["translation_m"]["max"].get<double>(), 0.5);
  EXPECT_EQ(json["rpe"]["count"], 9);
  EXPECT_EQ(json["segments"]["20.5m"]["count"], 5);
  EXPECT_EQ(json["estimate"], "estimate.txt");
  EXPECT_THAT(bytes_of(scratch_.path() / "out/errors.csv"), HasSubstr("\n20,0.5,0\n"));
  for (const char* picture : {"out/error.png", "out/path.png"})
    EXPECT_THAT(bytes_of(scratch_.path() / picture).substr(0, 4), "\x89PNG");
  EXPECT_THAT(bytes_of(scratch_.path() / "out/report.html"), HasSubstr("--align none"));
}

// Mutation: a broken gate that ends with 0.
TEST_F(EvaluationCommand, HoldsTheResultAgainstGates) {
  EXPECT_EQ(evaluate({"--gate", "ape.translation_m.max<=0.6"}).exit_code, 0);
  EXPECT_EQ(evaluate({"--segments-m", "2.5", "--gate", "segments.2.5m.count>=1"}).exit_code, 0);
  const Outcome broken = evaluate({"--gate", "ape.translation_m.max<=0.1"});
  EXPECT_EQ(broken.exit_code, 1);
  EXPECT_THAT(broken.out, HasSubstr("gate broken: ape.translation_m.max is 0.4"));
  const Outcome unknown = evaluate({"--gate", "ape.translation_m.rms<=0.1"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("did you mean ape.translation_m.rmse?"));
}

// Mutations: an option of filters that is passed over; an option of --evaluate alone that is.
TEST_F(EvaluationCommand, RefusesOptionsThatHaveNoMeaning) {
  const auto expect_refused = [](const Outcome& outcome, const char* why) {
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr(why));
  };
  expect_refused(evaluate({"--filters", "ekf"}), "--filters has no meaning beside --evaluate");
  expect_refused(evaluate({path("log")}), "log has no meaning beside --evaluate");
  expect_refused(evaluate({"--delta", "1km"}), "--delta: expected a number of poses, metres or seconds");
  expect_refused(evaluate({"--align", "4"}),
                 "--align: expected one of none, origin, se2, sim2, se3, sim3 (got '4')");
  expect_refused(evaluate({"--plane", "xz"}), "--plane: expected --align se2 or sim2 beside it");
  expect_refused(evaluate({"--most-dt-s", "nan"}), "expected a number from 0 to 1000000 (got 'nan')");
  expect_refused(evaluate({"--segments-m", "5,5"}), "--segments-m: expected each length once");
  expect_refused(evaluate({"--offset-s", "50"}), "no two times of estimate and truth lie within 0.01 s");
  expect_refused(run_stereobench({"slam", path("log"), "--align", "se3"}), "--evaluate");
  expect_refused(run_stereobench({"slam", "--evaluate", path("estimate.txt")}), "--truth");
  expect_refused(run_stereobench({"slam"}), "log is required");
}

// Mutation: the axes of another plane in the result.
TEST_F(EvaluationCommand, SaysInWhichPlaneItIs) {
  ASSERT_EQ(evaluate({"--align", "sim2", "--plane", "xz"}).exit_code, 0);
  const auto json = nlohmann::json::parse(bytes_of(scratch_.path() / "out/evaluation.json"));
  EXPECT_EQ(json["alignment"]["plane"], "xz");
  EXPECT_LT(json["path_length_m"].get<double>(), 120.0);  // without y, which goes up and down by six
}

TEST_F(EvaluationCommand, WritesNothingInADryRun) {
  const Outcome outcome = evaluate({"--dry-run"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("would score 50 pairs of poses"));
  EXPECT_FALSE(std::filesystem::exists(scratch_.path() / "out"));
}

}  // namespace
}  // namespace stereobench::harness
