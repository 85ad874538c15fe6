/// Baselines and findings as text: what is written is what is read.
#include "harness/suite/baseline.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/suite/findings_file.h"
#include "tests/complaint.h"
#include "tests/test_folder.h"

namespace stereobench::harness {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::NanSensitiveDoubleEq;

Baseline some_baseline() {
  return {.scenario = "office",
          .inputs = {"abc", "fingerprint", "stereobench"},
          .blessing = {"a reason", "1.2.3", ""},
          .seeds = {.seeds = {4, 2},
                    .metrics = {{"vision.recall", {1.0, std::numeric_limits<double>::quiet_NaN()}},
                                {"filters.ekf.ate_rms_m", {0.1 + 0.2, 1e-300}}}}};
}

// Mutations: numbers that are rounded; a value that does not exist and is read as 0.
TEST(BaselineFile, IsReadAsItWasWritten) {
  const TestFolder folder;
  const std::string text = baseline_text(some_baseline());
  const auto read = read_baseline(folder.write("office.json", text));
  ASSERT_TRUE(read);
  EXPECT_EQ(baseline_text(*read), text);
  EXPECT_EQ(read->inputs.pixels, "fingerprint");
  EXPECT_EQ(read->blessing.instead_of, "");
  EXPECT_THAT(read->seeds.seeds, ElementsAre(4, 2));
  EXPECT_THAT(read->seeds.metrics.at("vision.recall"),
              ElementsAre(1.0, NanSensitiveDoubleEq(std::numeric_limits<double>::quiet_NaN())));
  EXPECT_THAT(read->seeds.metrics.at("filters.ekf.ate_rms_m"), ElementsAre(0.1 + 0.2, 1e-300));
}

// A line a metric: version control shows which ones changed.
TEST(BaselineFile, HasOneLineAMetric) {
  EXPECT_THAT(baseline_text(some_baseline()), HasSubstr("\n    \"vision.recall\": [1, null]\n"));
}

TEST(BaselineFile, IsRefusedWhereItIsNone) {
  const TestFolder folder;
  EXPECT_FALSE(read_baseline(folder.path() / "nowhere.json"));
  EXPECT_THAT(complaint_of([&] { read_baseline(folder.write("a.json", "{}")); }),
              HasSubstr("a.json: expected \"schema\""));
  EXPECT_THAT(complaint_of([&] { read_baseline(folder.write("a.json", "[")); }), HasSubstr("a.json: "));
  std::string text = baseline_text(some_baseline());
  text.replace(text.find("[1, null]"), 9, "[1]");
  EXPECT_THAT(complaint_of([&] { read_baseline(folder.write("a.json", text)); }),
              HasSubstr("per_seed.vision.recall"));
}

DetectedBall ball(bool required, bool found) {
  return {{.is_required = required, .colour = 3, .range_m = 2.0},
          {.is_found = found,
           .range_error_m = found ? 0.00123456789 : 0.0,
           .left_error_px = Eigen::Vector2d(0.25, -0.00001),
           .right_error_px = Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN())}};
}

// Mutations: a lost ball that is read as found; rounding to whole pixels.
TEST(FindingsFile, IsReadAsItWasWrittenButForRounding) {
  const TestFolder folder;
  DetectedBalls balls = {{{7, 1, 0}, ball(true, true)}, {{7, 1, 1}, ball(true, false)}};
  balls[{7, 1, 1}].finding.wrong_colour = 5;
  const auto file = folder.write("balls.csv", findings_csv(balls));
  const DetectedBalls read = read_findings(file);
  ASSERT_EQ(read.size(), 2u);
  const BallFinding& found = read.at({7, 1, 0}).finding;
  EXPECT_TRUE(found.is_found);
  EXPECT_NEAR(found.range_error_m, 0.00123456789, 0.5e-7);
  EXPECT_NEAR(found.left_error_px.x(), 0.25, 0.5e-4);
  EXPECT_EQ(found.left_error_px.y(), 0.0);
  EXPECT_TRUE(std::isnan(found.right_error_px.x()));
  EXPECT_FALSE(read.at({7, 1, 1}).finding.is_found);
  EXPECT_EQ(read.at({7, 1, 1}).finding.wrong_colour, 5);
  EXPECT_EQ(findings_csv(read), findings_csv(balls));
}

// Mutations: a ball that had to be found and is gone is left out; truth of the findings, which have none.
TEST(FindingsFile, ArePairedWithTheBallsOfALaterRun) {
  DetectedBalls before = {{{0, 0, 0}, ball(true, true)},
                          {{0, 0, 1}, ball(true, true)},
                          {{0, 0, 2}, ball(false, true)},
                          {{0, 0, 3}, ball(true, false)}};
  for (auto& [key, known] : before) known.truth = {.is_required = known.truth.is_required};
  const DetectedBalls now = {{{0, 0, 0}, ball(true, false)}, {{0, 0, 3}, ball(true, true)}};
  const PairedBalls pairs = pair_findings(before, now);
  ASSERT_EQ(pairs.balls.size(), 2u);
  EXPECT_TRUE(pairs.balls[0].first.is_found);
  EXPECT_FALSE(pairs.balls[0].second.is_found);
  EXPECT_EQ(pairs.balls[0].truth.range_m, 2.0);
  EXPECT_EQ(pairs.balls[1].key.ball, 3);
  EXPECT_EQ(pairs.unpaired, 1);
}

}  // namespace
}  // namespace stereobench::harness
