#include "harness/report/sweep_picture.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "harness/report/axes.h"
#include "harness/report/legend.h"
#include "tests/harness/report/pixels.h"

namespace stereobench::harness {
namespace {

SweepCurve level(const std::string& name, std::size_t values, double half_interval = kNaN) {
  return {name, std::vector<MeanInterval>(values, {1.0, 1.0 - half_interval, 1.0 + half_interval})};
}

/// The columns in which a colour stands high: markers, not the thin line between them.
std::vector<double> marker_columns(const cv::Mat& image, const Colour& colour) {
  std::vector<int> height(static_cast<std::size_t>(image.cols), 0);
  for (const Point& p : pixels_of(image, colour)) ++height[static_cast<std::size_t>(p.x_px)];
  std::vector<double> centres;
  for (std::size_t i = 0; i < height.size(); ++i) {
    const std::size_t begin = i;
    while (i < height.size() && height[i] >= 3) ++i;
    if (i > begin + 1) centres.push_back(0.5 * static_cast<double>(begin + i));
  }
  return centres;
}

std::vector<double> ufastslam_columns(const SweepPicture& picture) {
  const cv::Mat image = decoded(draw_sweep_picture(picture));
  return marker_columns(image(cv::Rect(0, 0, 815, image.rows)), filter_stroke("ufastslam").colour);
}

// Catches: numbers placed one after the other as if they were names.
TEST(ReportSweep, NumbersStandInProportion) {
  const SweepPicture picture = {"", "noise", {"0", "1", "2", "4", "8"}, false, {}, {level("ufastslam", 5)}};
  const std::vector<double> x = ufastslam_columns(picture);
  ASSERT_EQ(x.size(), 5u);
  EXPECT_NEAR((x[1] - x[0]) / (x[4] - x[0]), 1.0 / 8.0, 0.004);
  EXPECT_NEAR((x[3] - x[0]) / (x[4] - x[0]), 0.5, 0.004);
}

TEST(ReportSweep, RatiosStandInProportionWhenAsked) {
  const SweepPicture picture = {"", "particles", {"1", "10", "1000"}, true, {}, {level("ufastslam", 3)}};
  const std::vector<double> x = ufastslam_columns(picture);
  ASSERT_EQ(x.size(), 3u);
  EXPECT_NEAR((x[1] - x[0]) / (x[2] - x[0]), 1.0 / 3.0, 0.004);
}

TEST(ReportSweep, NamesStandEvenly) {
  const SweepPicture picture = {"", "kind", {"1", "ten", "1000"}, false, {}, {level("ufastslam", 3)}};
  const std::vector<double> x = ufastslam_columns(picture);
  ASSERT_EQ(x.size(), 3u);
  EXPECT_NEAR(x[1] - x[0], x[2] - x[1], 1.0);
}

/// The rows between which a filter's curve with intervals about 1 has ink; the other filter keeps the axis.
AxisRange rows_with_ink(double half_interval) {
  const SweepPicture picture = {
      "", "n", {"1", "2"}, false, {}, {level("ufastslam", 2, half_interval), level("fastslam2", 2, 0.8)}};
  const cv::Mat image = decoded(draw_sweep_picture(picture));
  AxisRange rows = {1e9, 0.0};
  for (const Point& p :
       pixels_of(image(cv::Rect(0, 0, 815, image.rows)), filter_stroke("ufastslam").colour, 120.0)) {
    rows = {std::min(rows.low, p.y_px), std::max(rows.high, p.y_px)};
  }
  return rows;
}

// Catches: bars of half the interval, from the mean to the high end only, or none.
TEST(ReportSweep, BarsReachFromTheLowToTheHighEnd) {
  const AxisRange mean = rows_with_ink(kNaN);
  const AxisRange small = rows_with_ink(0.4);
  const AxisRange large = rows_with_ink(0.8);
  EXPECT_NEAR(small.high + small.low, mean.high + mean.low, 3.0);
  EXPECT_NEAR(large.high + large.low, mean.high + mean.low, 3.0);
  EXPECT_NEAR((small.high - small.low) / (large.high - large.low), 0.5, 0.02);
}

TEST(ReportSweep, EachDetectionErrorHasAPanel) {
  const std::vector<SweepCurve> ate = {level("ufastslam", 2)};
  const int rows_0 = decoded(draw_sweep_picture({"", "n", {"1", "2"}, false, {}, ate})).rows;
  const int rows_1 = decoded(draw_sweep_picture({"", "n", {"1", "2"}, false, {level("a", 2)}, ate})).rows;
  const int rows_2 =
      decoded(draw_sweep_picture({"", "n", {"1", "2"}, false, {level("a", 2), level("b", 2)}, ate})).rows;
  EXPECT_GT(rows_1, rows_0 + 100);
  EXPECT_EQ(rows_2 - rows_1, rows_1 - rows_0);
}

TEST(ReportSweep, NothingAndNonsenseAreCharts) {
  EXPECT_FALSE(decoded(draw_sweep_picture({})).empty());
  SweepCurve unknown = level("ufastslam", 2);
  unknown.values = {{kNaN, kNaN, kNaN}, {-1.0, kNaN, 1e300}};
  EXPECT_FALSE(decoded(draw_sweep_picture({"", "n", {"0", "-1"}, true, {unknown}, {unknown}})).empty());
}

TEST(ReportSweep, RefusesCurvesOfAnotherLength) {
  EXPECT_THROW(draw_sweep_picture({"", "n", {"1", "2"}, false, {}, {level("ufastslam", 3)}}),
               std::invalid_argument);
  EXPECT_THROW(draw_sweep_picture({"", "n", {"1"}, false, {level("a", 0)}, {}}), std::invalid_argument);
}

TEST(ReportSweep, TheSameSweepIsTheSameBytes) {
  const SweepPicture picture = {
      "t", "n", {"1", "2"}, false, {level("a", 2, 0.1)}, {level("ufastslam", 2, 0.1)}};
  EXPECT_EQ(draw_sweep_picture(picture), draw_sweep_picture(picture));
}

}  // namespace
}  // namespace stereobench::harness
