/// The picture and the page of a study: that they show its numbers.
#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/report/axes.h"
#include "harness/sensitivity/sensitivity_page.h"
#include "harness/sensitivity/sensitivity_picture.h"
#include "harness/sensitivity/sensitivity_report.h"
#include "tests/harness/report/pixels.h"

namespace stereobench::harness {
namespace {

using testing::Each;
using testing::ElementsAre;

constexpr Colour kFirstColour = {0.0, 0.447, 0.698, 1.0};
constexpr Colour kTotalColour = {0.902, 0.624, 0.0, 1.0};
constexpr int kPlotEnds_px = 670;

Sensitivity study_of_two(double first, double total) {
  Sensitivity study{.scenario = "s",
                    .metric = "m",
                    .factors = {.keys = {{"a"}}, .streams = {"seed"}},
                    .settings = {.samples = 64, .level = 0.95, .seed = 3},
                    .indices = {}};
  study.indices.factors = {{{0.125, {0.125, 0.125}}, {0.25, {0.25, 0.25}}, {}},
                           {{first, {first, first}}, {total, {total, total}}, {}}};
  return study;
}

/// How long the bars of a colour are, from the top to the bottom, in pixels.
std::vector<double> bars_of(const Sensitivity& study, const Colour& colour) {
  const cv::Mat image = decoded(draw_sensitivity_picture(study));
  std::vector<double> lengths;
  int last_row = -2;
  double left = 0.0, right = 0.0;
  for (const Point& p : pixels_of(image(cv::Rect(0, 0, kPlotEnds_px, image.rows)), colour)) {
    const int row = static_cast<int>(p.y_px);
    if (row > last_row + 1) {
      lengths.push_back(0.0);
      left = right = p.x_px;
    }
    left = std::min(left, p.x_px);
    right = std::max(right, p.x_px);
    lengths.back() = right - left;
    last_row = row;
  }
  return lengths;
}

// Mutations: the least at the top; the first index in the bar of the total.
TEST(SensitivityPicture, BarsAreAsLongAsIndices) {
  const std::vector<double> first = bars_of(study_of_two(0.5, 0.875), kFirstColour);
  const std::vector<double> total = bars_of(study_of_two(0.5, 0.875), kTotalColour);
  ASSERT_EQ(first.size(), 2u);
  ASSERT_EQ(total.size(), 2u);
  const double unit_px = total[0] / 0.875;
  EXPECT_GT(unit_px, 500.0);
  EXPECT_NEAR(first[0], 0.5 * unit_px, 3.0);
  EXPECT_NEAR(first[1], 0.125 * unit_px, 3.0);
  EXPECT_NEAR(total[1], 0.25 * unit_px, 3.0);
}

/// From where to where there is ink of lines between the bars' middles and the frame.
double whisker_px(double half_width) {
  Sensitivity study = study_of_two(0.5, 0.5);
  for (FactorIndices& factor : study.indices.factors)
    factor.first.interval = factor.total.interval = {NAN, NAN};
  study.indices.factors[1].total.interval = {0.5 - half_width, 0.5 + half_width};
  const cv::Mat image = decoded(draw_sensitivity_picture(study));
  AxisRange ink = {1e9, 0.0};
  for (const Point& p :
       pixels_of(image(cv::Rect(60, 50, kPlotEnds_px - 60, 100)), {0.13, 0.13, 0.13, 1.0}, 90.0))
    ink = {std::min(ink.low, p.x_px), std::max(ink.high, p.x_px)};
  return ink.high - ink.low;
}

// Mutation: a line from the index to the high end.
TEST(SensitivityPicture, LinesAreAsLongAsIntervals) {
  EXPECT_NEAR(whisker_px(0.4) / whisker_px(0.2), 2.0, 0.05);
}

TEST(SensitivityPicture, NothingAndNonsenseAreCharts) {
  EXPECT_FALSE(decoded(draw_sensitivity_picture({})).empty());
  EXPECT_FALSE(decoded(draw_sensitivity_picture(study_of_two(NAN, NAN))).empty());
  EXPECT_FALSE(decoded(draw_sensitivity_picture(study_of_two(-1e300, 1e300))).empty());
  EXPECT_EQ(draw_sensitivity_picture(study_of_two(0.5, 0.75)),
            draw_sensitivity_picture(study_of_two(0.5, 0.75)));
}

// Mutations: the smallest first; the high end for the low one; the first index for the total.
TEST(SensitivityPage, HasTheIndicesAsTableAndChart) {
  Sensitivity study = study_of_two(0.5, 0.875);
  study.indices.factors[1].total.interval = {0.75, 1.0};
  study.indices.factors[0].first.interval = {0.0, 0.25};
  const std::vector<std::string> words = {"stereobench", "sensitivity", "s.yaml", "--vary", "a=0..1"};
  const Page page = sensitivity_page(study, words);
  EXPECT_THAT(page.facts, testing::Contains("256 runs"));
  ASSERT_EQ(page.blocks.size(), 3u);
  for (const Block& block : page.blocks)
    EXPECT_THAT(block.commands, ElementsAre("stereobench sensitivity s.yaml --vary a=0..1"));
  EXPECT_EQ(std::get<PageText>(page.blocks[0].content).lines, sensitivity_remarks(study));
  const auto& table = std::get<PageTable>(page.blocks[1].content);
  std::vector<std::string> texts;
  for (const PageCell& cell : table.rows.at(0).cells) texts.push_back(cell.text);
  EXPECT_THAT(texts,
              ElementsAre("seed", "random numbers", "0.500", "0.500", "0.500", "0.875", "0.750", "1.000"));
  EXPECT_EQ(table.rows.at(1).cells.at(2).number, 0.125);
  const Chart& chart = std::get<PageCharts>(page.blocks[2].content).charts.at(0);
  EXPECT_THAT(chart.x_names, ElementsAre("seed", "a"));
  EXPECT_THAT(chart.series.at(0).y, ElementsAre(0.5, 0.125));
  EXPECT_THAT(chart.series.at(0).low, ElementsAre(0.5, 0.0));
  EXPECT_THAT(chart.series.at(1).y, ElementsAre(0.875, 0.25));
  EXPECT_THAT(chart.series.at(1).high, ElementsAre(1.0, 0.25));
  EXPECT_FALSE(page_html(page).empty());
}

TEST(SensitivityPage, ShowsNoCommandThatItDoesNotKnow) {
  for (const Block& block : sensitivity_blocks(study_of_two(NAN, NAN), {}))
    EXPECT_TRUE(block.commands.empty());
}

}  // namespace
}  // namespace stereobench::harness
