#include "harness/history/history_picture.h"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "tests/harness/report/pixels.h"

namespace stereobench::harness {
namespace {

constexpr Colour kWorseInk = {0.835, 0.369, 0.0, 1.0};
constexpr Colour kBetterInk = {0.0, 0.620, 0.451, 1.0};
constexpr Colour kMeansInk = {0.0, 0.447, 0.698, 1.0};

MetricHistory metric_of(std::vector<double> means, std::vector<HistoryStep> steps) {
  return {.metric = "filters.ekf.ate_rms_m",
          .means = std::move(means),
          .changed = true,
          .steps = std::move(steps)};
}

cv::Mat drawn(const MetricHistory& metric) {
  return decoded(draw_history_picture("history", {&metric}));
}

double mean_x(const cv::Mat& image, const Colour& colour) {
  return mean_of(pixels_of(image, colour)).x_px;
}

// Ten results: the middle of all dots is between 5 and 6, and so is a step from 5 to 6. Mutations: a step at
// the result behind it; a result without a value drawn as 0.
TEST(HistoryPicture, MarksAStepBetweenItsResults) {
  const MetricHistory metric = metric_of({-1, -1, -1, -1, -1, 1, 1, 1, 1, 1}, {{5, -1.0, 1.0, 20.0, 0.001}});
  const cv::Mat image = drawn(metric);
  EXPECT_NEAR(mean_x(image, kWorseInk), mean_x(image, kMeansInk), 1.5);
  EXPECT_TRUE(pixels_of(image, kBetterInk).empty());
  MetricHistory with_gap = metric;
  with_gap.means[0] = with_gap.means[9] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NEAR(mean_x(drawn(with_gap), kMeansInk), mean_x(image, kMeansInk), 1.5);
  const auto ink = [](const cv::Mat& of) { return pixels_of(of, kMeansInk).size(); };
  EXPECT_LT(static_cast<double>(ink(drawn(with_gap))),
            0.85 * static_cast<double>(ink(image)));  // two dots of ten are gone
}

TEST(HistoryPicture, TellsBetterFromWorse) {
  const cv::Mat image = drawn(metric_of({2, 2, 1, 1}, {{2, 2.0, 1.0, -10.0, 0.001}}));
  EXPECT_FALSE(pixels_of(image, kBetterInk).empty());
  EXPECT_TRUE(pixels_of(image, kWorseInk).empty());
}

// Mutation: in the order of names.
TEST(HistoryPicture, ShowsTheMetricsWithTheWorstStepsFirst) {
  History history;
  history.metrics = {metric_of({1, 1}, {}), metric_of({1, 2}, {{1, 1.0, 2.0, 20.0, 0.001}}),
                     metric_of({1, 3}, {{1, 1.0, 3.0, 40.0, 0.001}}), metric_of({1, 1}, {})};
  history.metrics[0].changed = false;
  const auto chosen = metrics_to_draw(history, 6);
  EXPECT_EQ(chosen, (std::vector<const MetricHistory*>{&history.metrics[2], &history.metrics[1],
                                                       &history.metrics[3], &history.metrics[0]}));
  EXPECT_EQ(metrics_to_draw(history, 2).size(), 2U);
}

}  // namespace
}  // namespace stereobench::harness
