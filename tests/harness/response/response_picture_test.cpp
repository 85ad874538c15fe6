#include "harness/response/response_picture.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "harness/report/legend.h"
#include "tests/harness/report/pixels.h"
#include "tests/harness/response/planted_response.h"

namespace stereobench::harness {
namespace {

constexpr int kRightOfPlot_px = 750;

/// A law without noise, with its knee at a level.
ResponseFit fit_with_knee(double knee, const std::vector<double>& levels, bool has_bound) {
  Response response =
      plant_response({{.floor_m = knee, .spread = 1e-3}}, {.floor_m = 0.1, .spread = 1e-3}, levels, 5);
  if (!has_bound) response.bound = {};
  return fit_response(response);
}

std::vector<Point> pixels_in_plot(const ResponseFit& fit, const Colour& colour) {
  const cv::Mat image = decoded(draw_response_picture(fit, "title"));
  return pixels_of(image(cv::Rect(0, 0, kRightOfPlot_px, 402)), colour);
}

double leftmost(const std::vector<Point>& points) {
  return std::ranges::min(points, {}, &Point::x_px).x_px;
}

// Mutations: errors that are not drawn; ratios in the panel of errors.
TEST(ReportResponse, IsDrawn) {
  const ResponseFit fit = fit_with_knee(0.3, {0.1, 0.2, 0.4, 0.8, 1.6}, true);
  EXPECT_GT(pixels_in_plot(fit, filter_stroke("smoother").colour).size(), 300U);
  EXPECT_GT(pixels_in_plot(fit, kBlack).size(), 300U);
  const cv::Mat image = decoded(draw_response_picture(fit, "title"));
  EXPECT_GT(pixels_of(image(cv::Rect(85, 465, 650, 160)), filter_stroke("smoother").colour).size(), 200U);
}

// Knees at 0.2, 0.4 and 0.8 are equally far apart on a logarithmic axis. Mutation: the mark at the floor.
TEST(ReportResponse, KneesAreMarkedAtTheirLevel) {
  std::vector<double> x;
  for (const double knee : {0.2, 0.4, 0.8})
    x.push_back(mean_of(pixels_in_plot(fit_with_knee(knee, {0.1, 0.2, 0.4, 0.8, 1.6}, false), kBlack)).x_px);
  EXPECT_NEAR(x[1] - x[0], x[2] - x[1], 1.5);
  EXPECT_GT(x[1] - x[0], 80.0);
}

// Mutation: level 0 left out.
TEST(ReportResponse, LevelZeroStandsBeforeTheOthers) {
  const Colour colour = filter_stroke("smoother").colour;
  const double with = leftmost(pixels_in_plot(fit_with_knee(0.3, {0.0, 0.1, 0.2, 0.4}, false), colour));
  const double without = leftmost(pixels_in_plot(fit_with_knee(0.3, {0.1, 0.2, 0.4}, false), colour));
  EXPECT_LT(with, 110.0);
  EXPECT_GT(with, 90.0);
  EXPECT_NEAR(without, 84.5, 1.5);  // the law goes on to the edge
}

// Mutation: a law that does not hold is drawn as a line.
TEST(ReportResponse, DrawsWithoutLawAndBound) {
  const ResponseFit bare = fit_with_knee(0.3, {0.1, 0.2}, false);
  EXPECT_GT(pixels_in_plot(bare, filter_stroke("smoother").colour).size(), 30U);
  EXPECT_TRUE(pixels_in_plot(bare, kBlack).empty());
  const int rows = decoded(draw_response_picture(bare, "")).rows;
  EXPECT_GT(decoded(draw_response_picture(fit_with_knee(0.3, {0.1, 0.2}, true), "")).rows, rows + 200);
  EXPECT_FALSE(decoded(draw_response_picture({}, "")).empty());
  EXPECT_FALSE(decoded(draw_response_picture(fit_with_knee(0.3, {0.0}, true), "")).empty());
}

TEST(ReportResponse, TheSameFitIsTheSameBytes) {
  const ResponseFit fit = fit_with_knee(0.3, {0.0, 0.1, 0.2, 0.4}, true);
  EXPECT_EQ(draw_response_picture(fit, "t"), draw_response_picture(fit, "t"));
}

}  // namespace
}  // namespace stereobench::harness
