#include "harness/report/error_picture.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "harness/report/legend.h"
#include "tests/harness/report/pixels.h"

namespace stereobench::harness {
namespace {

const std::vector<double> kTime_s = {0.0, 1.0, 2.0, 3.0, 4.0};

ErrorCurves curves_of(const std::string& filter, const std::vector<std::vector<double>>& runs) {
  ErrorCurves curves(filter);
  for (const std::vector<double>& errors_m : runs) curves.add(errors_m);
  return curves;
}

ErrorCurves constant(const std::string& filter, double error_m) {
  return curves_of(filter, {std::vector<double>(kTime_s.size(), error_m)});
}

/// The row on which a filter's level curve is drawn, legend left out.
double row_of(const cv::Mat& image, const std::string& filter) {
  return mean_of(pixels_of(image(cv::Rect(0, 0, 800, image.rows)), filter_stroke(filter).colour, 70.0)).y_px;
}

// Catches: a logarithmic axis for errors of one size, an axis that does not begin at zero upside down.
TEST(ReportErrors, EqualDifferencesAreEqualDistances) {
  const ErrorPicture picture = {
      "", kTime_s, {constant("smoother", 1.0), constant("fastslam2", 2.0), constant("ufastslam", 3.0)}};
  const cv::Mat image = decoded(draw_error_picture(picture));
  EXPECT_GT(row_of(image, "smoother"), row_of(image, "ufastslam") + 50.0);
  EXPECT_NEAR(row_of(image, "smoother") - row_of(image, "fastslam2"),
              row_of(image, "fastslam2") - row_of(image, "ufastslam"), 1.5);
}

TEST(ReportErrors, EqualRatiosAreEqualDistancesWhenSizesDiffer) {
  const ErrorPicture picture = {
      "", kTime_s, {constant("smoother", 0.01), constant("fastslam2", 0.1), constant("ufastslam", 1.0)}};
  const cv::Mat image = decoded(draw_error_picture(picture));
  EXPECT_GT(row_of(image, "smoother"), row_of(image, "ufastslam") + 50.0);
  EXPECT_NEAR(row_of(image, "smoother") - row_of(image, "fastslam2"),
              row_of(image, "fastslam2") - row_of(image, "ufastslam"), 1.5);
}

// The rms of 1 and 3 is drawn at the root of 5, the band reaches from 1 to 3.
// Catches: the mean, the median or the last run for the rms; a band of one run.
TEST(ReportErrors, RmsAndBandAreThoseOfTheRuns) {
  ErrorCurves runs = constant("ufastslam", 1.0);
  runs.add(std::vector<double>(kTime_s.size(), 3.0));
  runs.add(std::vector<double>(kTime_s.size(), kNaN));
  const ErrorPicture picture = {"", kTime_s, {runs, constant("fastslam2", 2.0), constant("smoother", 3.0)}};
  const cv::Mat image = decoded(draw_error_picture(picture));
  const double row_of_2 = row_of(image, "fastslam2");
  const double row_of_3 = row_of(image, "smoother");
  EXPECT_NEAR(row_of(image, "ufastslam"), row_of_2 + (std::sqrt(5.0) - 2.0) * (row_of_3 - row_of_2), 1.5);
  const auto is_white = [&](double row) { return image.at<cv::Vec3b>(static_cast<int>(row), 330)[2] > 250; };
  EXPECT_FALSE(is_white(row_of_3 + 6.0));
  EXPECT_TRUE(is_white(row_of_3 - 6.0));
  EXPECT_FALSE(is_white(2.0 * row_of_2 - row_of_3 - 6.0));
  EXPECT_TRUE(is_white(2.0 * row_of_2 - row_of_3 + 6.0));
}

/// The row of the bound's dots; axes and letters are dark, too, but not in the middle of the plot.
double row_of_bound(const cv::Mat& image) {
  return mean_of(pixels_of(image(cv::Rect(300, 50, 500, 374)), kBlack, 60.0)).y_px + 50.0;
}

// Catches: a bound that is not drawn, or that does not count for the axis.
TEST(ReportErrors, TheBoundIsACurveAmongThem) {
  ErrorPicture picture = {"", kTime_s, {constant("fastslam2", 2.0), constant("ufastslam", 3.0)}};
  picture.bound_m = std::vector<double>(kTime_s.size(), 1.0);
  const cv::Mat image = decoded(draw_error_picture(picture));
  EXPECT_NEAR(row_of_bound(image) - row_of(image, "fastslam2"),
              row_of(image, "fastslam2") - row_of(image, "ufastslam"), 1.5);
  picture.bound_m.assign(kTime_s.size(), 0.1);
  picture.bound_m.front() = 0.0;  // a start that is known: nowhere on a logarithmic axis
  const cv::Mat logarithmic = decoded(draw_error_picture(picture));
  const double decade = row_of_bound(logarithmic) - row_of(logarithmic, "fastslam2");
  EXPECT_NEAR((row_of(logarithmic, "fastslam2") - row_of(logarithmic, "ufastslam")) / decade,
              std::log(1.5) / std::log(20.0), 0.05);
}

// Catches: the rms of the mean curve, or over all runs at once, in place of the mean of the runs' rms.
TEST(ReportErrors, RmsIsTheMeanOfTheRunsRms) {
  const ErrorCurves curves = curves_of("ufastslam", {{3.0, 4.0, kNaN}, {1.0, 1.0}, {kNaN}});
  EXPECT_NEAR(curves.mean_rms_m(), 0.5 * (std::sqrt(12.5) + 1.0), 1e-12);
  EXPECT_TRUE(std::isnan(ErrorCurves("ufastslam").mean_rms_m()));
}

TEST(ReportErrors, NothingAndNonsenseAreCharts) {
  EXPECT_FALSE(decoded(draw_error_picture({})).empty());
  EXPECT_FALSE(decoded(draw_error_picture({"", kTime_s, {constant("ufastslam", kNaN)}})).empty());
  EXPECT_FALSE(decoded(draw_error_picture({"", kTime_s, {constant("ufastslam", 0.0)}})).empty());
  EXPECT_FALSE(decoded(draw_error_picture({"", {0.0}, {constant("ufastslam", 1.0)}})).empty());
  EXPECT_FALSE(decoded(draw_error_picture({"", kTime_s, {curves_of("fastslam2", {{0.1}})}})).empty());
  EXPECT_FALSE(decoded(draw_error_picture({"", kTime_s, {}, {0.1, kNaN}})).empty());
}

/// The row of a filter's curve in the panel below.
double row_in_panel(const cv::Mat& image, const std::string& filter) {
  const cv::Mat panel = image(cv::Rect(0, 490, 800, image.rows - 490));
  return mean_of(pixels_of(panel, filter_stroke(filter).colour, 70.0)).y_px;
}

// Catches: a linear axis; a panel without its band; a panel where there is nothing to say.
TEST(ReportErrors, NormalisedErrorsAreAPanelBelow) {
  ErrorPicture picture = {"", kTime_s, {constant("fastslam2", 2.0)}};
  const int without = decoded(draw_error_picture(picture)).rows;
  picture.anees.filters = {{"fastslam2", {kNaN, 10.0, 10.0, 10.0, 10.0}},
                           {"ufastslam", {kNaN, 100.0, 100.0, 100.0, 100.0}},
                           {"smoother", std::vector<double>(5, 1000.0)}};
  picture.anees.low = {kNaN, 0.5, 0.5, 0.5, 0.5};
  picture.anees.high = {kNaN, 1.5, 1.5, 1.5, 1.5};
  const cv::Mat image = decoded(draw_error_picture(picture));
  EXPECT_GT(image.rows, without);
  const double decade = row_in_panel(image, "fastslam2") - row_in_panel(image, "ufastslam");
  EXPECT_GT(decade, 10.0);
  EXPECT_NEAR(row_in_panel(image, "ufastslam") - row_in_panel(image, "smoother"), decade, 1.5);
  const auto is_white = [&](double row) {
    return image.at<cv::Vec3b>(490 + static_cast<int>(row), 485)[2] > 250;
  };
  const double row_of_1 = row_in_panel(image, "fastslam2") + decade;
  EXPECT_FALSE(is_white(row_of_1 + 0.2 * decade));
  EXPECT_TRUE(is_white(row_of_1 - 0.4 * decade));
  for (AneesCurve& curve : picture.anees.filters) curve.anees.assign(5, kNaN);
  EXPECT_EQ(decoded(draw_error_picture(picture)).rows, without);
}

// Mutation: a chart of 1000 pixels whatever its names.
TEST(ReportErrors, LongNamesFit) {
  const cv::Mat image =
      decoded(draw_error_picture({"", kTime_s, {constant("fastslam2_block", 1.0), constant("ekf", 2.0)}}));
  const cv::Mat border = image(cv::Rect(image.cols - 8, 0, 8, image.rows));
  EXPECT_EQ(cv::countNonZero(border.reshape(1) != 255), 0);
}

TEST(ReportErrors, TheSameErrorsAreTheSameBytes) {
  const ErrorPicture picture = {"t", kTime_s, {constant("ufastslam", 1.0), constant("fastslam2", 2.0)}};
  EXPECT_EQ(draw_error_picture(picture), draw_error_picture(picture));
}

}  // namespace
}  // namespace stereobench::harness
