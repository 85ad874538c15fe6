#include "harness/report/canvas.h"

#include <limits>
#include <set>
#include <stdexcept>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "harness/report/legend.h"
#include "slam/filter_registry.h"
#include "tests/harness/report/pixels.h"

namespace stereobench::harness {
namespace {

// Anti-aliased ink adds up to the figure's area: 60 px of a line 2.5 px wide.
TEST(ReportCanvas, InkOfALineIsItsLengthTimesItsWidth) {
  Canvas canvas(100, 100);
  const std::vector<Point> line = {{20.3, 20.7}, {20.3 + 36.0, 20.7 + 48.0}};
  canvas.draw_line(line, {kBlack, 2.5});
  EXPECT_NEAR(black_area(decoded(canvas.png())), 150.0, 2.0);
}

// Catches: a path that begins where text ended (a wedge from the text to the figure).
TEST(ReportCanvas, InkOfAPolygonIsItsAreaAlsoAfterText) {
  Canvas canvas(200, 200);
  const std::vector<Point> square = {{120.0, 120.0}, {150.0, 120.0}, {150.0, 150.0}, {120.0, 150.0}};
  canvas.write({10.0, 20.0}, "text", {.colour = {1.0, 1.0, 1.0, 1.0}});
  canvas.fill(square, kBlack);
  EXPECT_NEAR(black_area(decoded(canvas.png())), 900.0, 2.0);
}

TEST(ReportCanvas, LinesAreInterruptedAndPolygonsLeftOutAtWhatIsNotFinite) {
  Canvas canvas(100, 100);
  const std::vector<Point> line = {{10.0, 50.0}, {30.0, 50.0}, {kNaN, 50.0}, {60.0, 50.0}, {80.0, 50.0}};
  canvas.draw_line(line, {kBlack, 2.0});
  EXPECT_NEAR(black_area(decoded(canvas.png())), 80.0, 1.0);
  const std::vector<Point> corners = {{0.0, 0.0}, {90.0, 0.0}, {90.0, kNaN}};
  canvas.fill(corners, kBlack);
  canvas.write({kNaN, 10.0}, "nowhere", {});
  EXPECT_NEAR(black_area(decoded(canvas.png())), 80.0, 1.0);
}

// Catches: fixed-point overflow, which folds far points back onto the sheet.
TEST(ReportCanvas, FarPointsDoNotFoldBack) {
  for (const double far_px : {1e7, 3e7, 1e12}) {
    Canvas canvas(100, 100);
    const std::vector<Point> line = {{20.0, 50.0}, {far_px, 50.0}};
    canvas.draw_line(line, {kBlack, 2.0});
    EXPECT_NEAR(black_area(decoded(canvas.png())), 160.0, 1.0);
  }
}

TEST(ReportCanvas, TextStandsAboutItsPoint) {
  for (const bool upwards : {false, true}) {
    Canvas canvas(200, 200);
    canvas.write({100.0, 100.0}, "HHHHHHHH",
                 {.size_px = 14.0, .colour = kBlack, .align_x = 0.5, .upwards = upwards});
    const std::vector<Point> ink = pixels_of(decoded(canvas.png()), kBlack, 300.0);
    ASSERT_FALSE(ink.empty());
    EXPECT_NEAR(mean_of(ink).x_px, 100.0, 1.0);
    EXPECT_NEAR(mean_of(ink).y_px, 100.0, 1.0);
  }
  const Canvas canvas(10, 10);
  EXPECT_NEAR(canvas.text_width_px("HHHH", {}), 2.0 * canvas.text_width_px("HH", {}), 1e-6);
}

TEST(ReportCanvas, ClipKeepsInkInsideTheBoxUntilItIsLifted) {
  Canvas canvas(100, 100);
  const std::vector<Point> line = {{0.0, 50.0}, {100.0, 50.0}};
  canvas.clip_to(Box{20.0, 0.0, 30.0, 100.0});
  canvas.draw_line(line, {kBlack, 2.0});
  EXPECT_NEAR(black_area(decoded(canvas.png())), 60.0, 0.5);
  canvas.clip_to({});
  canvas.draw_line(line, {kBlack, 2.0});
  EXPECT_NEAR(black_area(decoded(canvas.png())), 200.0, 0.5);
}

// Catches: red and blue swapped; rows of a submatrix read as if they had no padding.
TEST(ReportCanvas, APictureComesBackAsItWas) {
  cv::Mat whole(40, 50, CV_8UC3);
  cv::randu(whole, 0, 256);
  const cv::Mat part = whole(cv::Rect(3, 4, 33, 21));
  EXPECT_EQ(cv::norm(decoded(Canvas(part).png()), part, cv::NORM_INF), 0.0);
}

TEST(ReportCanvas, RefusesWhatIsNoSheet) {
  EXPECT_THROW(Canvas(0, 10), std::invalid_argument);
  EXPECT_THROW(Canvas(10, 20000), std::invalid_argument);
  EXPECT_THROW(Canvas(cv::Mat{}), std::invalid_argument);
  EXPECT_THROW(Canvas(cv::Mat(4, 4, CV_8UC1)), std::invalid_argument);
}

TEST(ReportCanvas, TextThatIsNotUtf8IsAnErrorAndNotAnEmptyPicture) {
  Canvas canvas(10, 10);
  canvas.write({1.0, 1.0}, "\xff", {});
  EXPECT_THROW(canvas.png(), std::runtime_error);
}

TEST(ReportLegend, FiltersHaveALookOfTheirOwn) {
  EXPECT_EQ(filter_stroke("dead_reckoning").dash, Dash::kDashed);
  EXPECT_NE(filter_stroke("ufastslam").colour.red, filter_stroke("fastslam2").colour.red);
  EXPECT_EQ(filter_stroke("mine").colour.green, filter_stroke("mine").colour.green);
  EXPECT_NE(filter_stroke("mine").colour.green, filter_stroke("ufastslam").colour.green);
  EXPECT_EQ(filter_title("ufastslam"), "UFastSLAM");
  EXPECT_EQ(filter_title("ufastslam_block"), "UFastSLAM in blocks");
  EXPECT_NE(filter_stroke("ufastslam_block").dash, filter_stroke("ufastslam").dash);
  EXPECT_EQ(filter_title("mine"), "mine");
}

// Mutation: colours alone, of which there are three for five filters.
TEST(ReportLegend, NoTwoFiltersLookAlike) {
  std::set<std::tuple<double, double, Dash>> looks;
  for (const std::string& filter : slam::filter_names()) {
    const Stroke stroke = filter_stroke(filter);
    EXPECT_TRUE(looks.insert({stroke.colour.red, stroke.colour.green, stroke.dash}).second) << filter;
  }
}

TEST(ReportLegend, IsAsWideAsItSays) {
  Canvas canvas(400, 200);
  const std::vector<LegendEntry> entries = {{"a filter", "rms 0.1 m", Mark::kLine, {kBlack}},
                                            {"a longer name", "", Mark::kDisc, {kBlack}}};
  draw_legend(canvas, {10.0, 10.0}, entries);
  const cv::Mat image = decoded(canvas.png());
  const int width_px = static_cast<int>(legend_width_px(canvas, entries));
  EXPECT_EQ(black_area(image(cv::Rect(12 + width_px, 0, 200, 200))), 0.0);
  EXPECT_GT(black_area(image(cv::Rect(10 + width_px - 12, 0, 14, 200))), 0.0);
  EXPECT_EQ(legend_width_px(canvas, {}), 0.0);
}

}  // namespace
}  // namespace stereobench::harness
