#include "harness/response/response_words.h"

#include <limits>

#include <gmock/gmock.h>

#include "harness/response/response_page.h"
#include "harness/response/response_table.h"

namespace stereobench::harness {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();

/// A filter with a knee in the middle of the levels and 1.05 times the bound below it.
CurveFit good_curve(const std::string& name) {
  CurveFit curve{.name = name, .levels = std::vector<LevelError>(3), .law = ResponseLaw{}};
  ResponseLaw& law = *curve.law;
  law.law = {.floor = 0.012, .slope = 0.0387};
  law.floor_m = {0.012, {0.011, 0.013}};
  law.slope = {0.0387, {0.03, 0.05}};
  law.knee = {0.31, {0.25, 0.4}};
  law.upper_knee = {kEndless, {kEndless, kEndless}};
  law.exponent = {0.98, {0.9, 1.1}};
  law.exponent_of_law = 0.97;
  law.floor_over_bound = {1.05, {1.02, 1.08}};
  law.farthest = 2;
  for (LevelError& error : curve.levels) error = {10, {0.1, {0.05, 0.2}}, {1.1, {1.0, 1.2}}, -0.04, true};
  curve.levels[2].off_law = 0.45;
  return curve;
}

ResponseFit fit_of_curve(const CurveFit& filter) {
  CurveFit bound = good_curve("bound");
  bound.law->floor_over_bound = {};
  return {"detector_noise.centre_sd_px", {0.125, 0.5, 2.0}, 10, {filter}, bound};
}

/// The last sentence: that of the filter.
std::string sentence(const ResponseFit& fit) {
  return response_sentences(fit).back();
}

TEST(ResponseWords, NameOdometryAndGeometry) {
  EXPECT_THAT(
      response_sentences(fit_of_curve(good_curve("smoother"))),
      testing::ElementsAre(
          "bound: below 0.31 px (0.25 to 0.40) of detector_noise.centre_sd_px the error "
          "is that of odometry, geometry and other noise",
          "smoother: below 0.31 px (0.25 to 0.40) of detector_noise.centre_sd_px the "
          "error is that of odometry, geometry and other noise: 1.05 (1.02 to 1.08) times the bound"));
}

// Of the square of 1.42 times the bound more than half is the filter's. Mutations: sqrt(2) for 1, for 2; the
// value in place of the end of the interval.
TEST(ResponseWords, NameTheFilter) {
  CurveFit curve = good_curve("fastslam1");
  curve.law->floor_over_bound = {2.3, {1.42, 3.1}};
  EXPECT_EQ(sentence(fit_of_curve(curve)),
            "fastslam1: below 0.31 px (0.25 to 0.40) of detector_noise.centre_sd_px the error is mostly the "
            "filter's own: 2.30 (1.42 to 3.10) times the bound");
  curve.law->floor_over_bound = {kEndless, {3.0, kEndless}};  // the bound has no floor
  EXPECT_THAT(sentence(fit_of_curve(curve)),
              testing::EndsWith("the filter's own: 3.00 or more times the bound"));
}

TEST(ResponseWords, SayWhereSeedsAreTooFewToName) {
  CurveFit curve = good_curve("ekf");
  for (const Interval& interval : {Interval{1.40, 3.0}, {0.9, 1.42}}) {
    curve.law->floor_over_bound = {1.41, interval};
    EXPECT_THAT(sentence(fit_of_curve(curve)),
                testing::HasSubstr("these seeds do not say whose most is: 1.41 ("));
  }
}

// Mutation: the floor of a bound that does not follow the law is compared.
TEST(ResponseWords, NameNobodyWithoutABound) {
  ResponseFit fit = fit_of_curve(good_curve("ekf"));
  const std::string nobody =
      "ekf: below 0.31 px (0.25 to 0.40) of detector_noise.centre_sd_px the error is not the sensor's";
  fit.bound->law->holds = false;
  EXPECT_EQ(sentence(fit), nobody);
  fit.bound = {};
  EXPECT_EQ(sentence(fit), nobody);
}

// Mutation: a floor of which the interval begins at 0 is one.
TEST(ResponseWords, SayThatThereIsNoFloor) {
  CurveFit curve = good_curve("ekf");
  curve.law->floor_m = {0.001, {0.0, 0.004}};
  curve.law->knee = {0.03, {0.0, 0.1}};
  EXPECT_EQ(
      sentence(fit_of_curve(curve)),
      "ekf: at all levels of detector_noise.centre_sd_px, from 0.125 px on, the error is that of the sensor; "
      "a knee is below 0.10 px");
  curve.law->knee = {0.03, {0.0, 0.2}};
  EXPECT_EQ(
      sentence(fit_of_curve(curve)),
      "ekf: from 0.20 px of detector_noise.centre_sd_px on the error is that of the sensor; whether there is "
      "a floor below it, these levels do not say");
}

// A knee below the lowest level above 0 is one where level 0 shows the floor.
TEST(ResponseWords, KneesBelowTheLevelsAreSaidWhereTheFloorIsSeen) {
  ResponseFit fit = fit_of_curve(good_curve("ekf"));
  fit.levels = {0.0, 0.5, 2.0};
  EXPECT_THAT(sentence(fit), testing::StartsWith("ekf: below 0.31 px (0.25 to 0.40)"));
}

// Mutations: a slope of which the interval begins at 0 is one; a knee that is surely beyond the levels is
// one.
TEST(ResponseWords, SayThatTheSensorDoesNotMatter) {
  const std::string no_matter =
      "dead_reckoning: up to 2 px of detector_noise.centre_sd_px, the highest level, the sensor does not "
      "matter: "
      "the error, 0.012 m (0.011 to 0.013), is mostly the filter's own: 4.00 (3.00 to 5.00) times the bound";
  CurveFit curve = good_curve("dead_reckoning");
  curve.law->floor_over_bound = {4.0, {3.0, 5.0}};
  curve.law->slope = {0.001, {0.0, 0.004}};
  curve.law->knee = {12.0, {1.0, kEndless}};
  EXPECT_EQ(sentence(fit_of_curve(curve)), no_matter);
  curve.law->slope = {0.001, {0.0005, 0.004}};
  curve.law->knee = {12.0, {2.1, 20.0}};
  EXPECT_EQ(sentence(fit_of_curve(curve)), no_matter);
  curve.law->knee = {3.0, {1.9, 20.0}};
  EXPECT_THAT(sentence(fit_of_curve(curve)), testing::StartsWith("dead_reckoning: below 3.0 px (1.9 to 20)"));
}

// Mutation: left out where there is no floor.
TEST(ResponseWords, SayFromWhereOnOdometryKnowsMore) {
  CurveFit curve = good_curve("ekf");
  curve.law->upper_knee = {1.5, {1.2, 2.0}};
  EXPECT_THAT(sentence(fit_of_curve(curve)),
              testing::EndsWith(
                  "times the bound; above 1.5 px (1.2 to 2.0) odometry knows more than the sensor says"));
  curve.law->floor_m.interval.low = 0.0;
  EXPECT_THAT(sentence(fit_of_curve(curve)), testing::EndsWith("odometry knows more than the sensor says"));
}

TEST(ResponseWords, SayThatTheLawDoesNotHold) {
  CurveFit curve = good_curve("ekf");
  curve.law->holds = false;
  EXPECT_EQ(
      sentence(fit_of_curve(curve)),
      "ekf: no knee: the error at 2 px of detector_noise.centre_sd_px is 45 % above what a floor and a line "
      "give; over the upper levels it grows as the level to the power 0.980 (0.900 to 1.10)");
  curve.levels[2].off_law = -0.3;
  EXPECT_THAT(sentence(fit_of_curve(curve)), testing::HasSubstr("is 30 % below what"));
}

TEST(ResponseWords, SayNothingWithoutALaw) {
  CurveFit curve = good_curve("ekf");
  curve.law = {};
  ResponseFit fit = fit_of_curve(curve);
  fit.bound = {};
  EXPECT_TRUE(response_sentences(fit).empty());
  EXPECT_TRUE(response_table(fit).empty());
  EXPECT_TRUE(response_blocks(fit).empty());
  EXPECT_TRUE(response_json(fit)["filters"][0]["law"].is_null());
}

TEST(ResponseWords, LevelsHaveTheUnitOfTheirKey) {
  EXPECT_EQ(level_word(0.5, "oracle.range_sd_m"), "0.5 m");
  EXPECT_EQ(level_word(2.0, "camera.noise_sd_levels"), "2");
}

TEST(ResponseTable, HasARowForEachCurveAndItsSentence) {
  const std::string table = response_table(fit_of_curve(good_curve("ekf")));
  EXPECT_THAT(table, testing::HasSubstr("knee [px]"));
  EXPECT_THAT(table, testing::HasSubstr("slope [m / px]"));
  EXPECT_THAT(table, testing::ContainsRegex(
                         "\nekf +0.0120 .0.0110 to 0.0130. +0.0387 .0.0300 to 0.0500. +0.310 "
                         ".0.250 to 0.400. +- +0.980 .0.900 to 1.10. .0.97. +.45 % at 2 px +1.05 "));
  EXPECT_THAT(table, testing::HasSubstr("\nekf: below 0.31 px"));
}

// Mutation: a level's ratio under the name of its error.
TEST(ResponseJson, HasLawsAndLevels) {
  CurveFit curve = good_curve("ekf");
  curve.law->knee.interval.high = kEndless;
  const nlohmann::ordered_json json = response_json(fit_of_curve(curve));
  EXPECT_EQ(json["parameter"], "detector_noise.centre_sd_px");
  EXPECT_EQ(json["bound"]["name"], "bound");
  EXPECT_TRUE(json["bound"]["law"]["floor_over_bound"]["value"].is_null());
  const auto& law = json["filters"][0]["law"];
  EXPECT_EQ(law["knee"]["value"], 0.31);
  EXPECT_EQ(law["knee"]["ci95_low"], 0.25);
  EXPECT_TRUE(law["knee"]["ci95_high"].is_null());
  EXPECT_EQ(law["farthest_level"], 2.0);
  const auto& level = json["filters"][0]["levels"][1];
  EXPECT_EQ(level["level"], 0.5);
  EXPECT_EQ(level["error_rms_m"]["ci95_high"], 0.2);
  EXPECT_EQ(level["over_bound"]["value"], 1.1);
  EXPECT_EQ(level["off_law"], -0.04);
  EXPECT_EQ(json["sentences"].size(), 2U);
}

// Mutations: a law that does not hold is drawn; the bound among the ratios.
TEST(ResponseBlocks, HaveSentencesLawsAndCharts) {
  ResponseFit fit = fit_of_curve(good_curve("ekf"));
  fit.levels = {0.0, 0.5, 2.0};
  const std::vector<Block> blocks = response_blocks(fit);
  ASSERT_EQ(blocks.size(), 3U);
  EXPECT_EQ(std::get<PageText>(blocks[0].content).lines, response_sentences(fit));
  const PageTable& table = std::get<PageTable>(blocks[1].content);
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.rows[1].cells.size(), table.header.size());
  EXPECT_EQ(table.rows[1].cells[3].number, 0.31);
  const std::vector<Chart>& charts = std::get<PageCharts>(blocks[2].content).charts;
  ASSERT_EQ(charts.size(), 2U);
  ASSERT_EQ(charts[0].series.size(), 4U);
  EXPECT_EQ(charts[0].series[3].x.front(), 0.5);
  EXPECT_EQ(charts[0].series[3].x.back(), 2.0);
  EXPECT_EQ(charts[0].series[3].y.back(), fit.filters[0].law->law.at(2.0));
  ASSERT_EQ(charts[1].series.size(), 1U);
  EXPECT_EQ(charts[1].series[0].high, std::vector(3, 1.2));
  EXPECT_NO_THROW(page_html({.title = "t", .facts = {}, .blocks = blocks}));
  fit.filters[0].law->holds = false;
  EXPECT_EQ(std::get<PageCharts>(response_blocks(fit)[2].content).charts[0].series.size(), 3U);
}

}  // namespace
}  // namespace stereobench::harness
