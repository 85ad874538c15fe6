#include "harness/history/history.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "harness/history/history_report.h"

namespace stereobench::harness {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
const char* const kEkfAte = "filters.ekf.ate_rms_m";

/// Results in which a metric has a level, times 1, 1.01, 1.02, ... for the seeds 0, 1, 2, ...
std::vector<SeedTable> results_of(const std::map<std::string, std::vector<double>>& levels,
                                  std::size_t seeds = 20) {
  std::vector<SeedTable> results(levels.begin()->second.size());
  for (std::size_t i = 0; i < results.size(); ++i)
    for (std::size_t seed = 0; seed < seeds; ++seed) {
      results[i].seeds.push_back(seed);
      for (const auto& [metric, level] : levels)
        results[i].metrics[metric].push_back(level[i] * (1.0 + 0.01 * static_cast<double>(seed)));
    }
  return results;
}

MetricHistory history_of_levels(const std::string& metric, const std::vector<double>& levels) {
  return history_of(results_of({{metric, levels}}), {}).metrics.at(0);
}

// Mutations: the step a result early; levels over all results before and after; margins of the level after.
TEST(History, HasAStepBetweenTwoLevels) {
  const MetricHistory metric = history_of_levels(kEkfAte, {1, 1, 1, 1.2, 1.2, 1.2, 0.9, 0.9});
  ASSERT_EQ(metric.steps.size(), 2U);
  EXPECT_EQ(metric.steps[0].result, 3U);
  EXPECT_NEAR(metric.steps[0].before, 1.095, 1e-12);
  EXPECT_NEAR(metric.steps[0].after, 1.2 * 1.095, 1e-12);
  EXPECT_NEAR(metric.steps[0].worse_by, 0.2 / 0.05, 1e-9);
  EXPECT_TRUE(metric.steps[0].is_worse());
  EXPECT_EQ(metric.steps[1].result, 6U);
  EXPECT_NEAR(metric.steps[1].before, 1.2 * 1.095, 1e-12);
  EXPECT_NEAR(metric.steps[1].worse_by, -0.25 / 0.05, 1e-9);
  EXPECT_TRUE(metric.steps[1].is_better());
}

// Mutation: larger is worse, whatever the metric.
TEST(History, KnowsWhichWayIsWorse) {
  const auto worse_by = [](const std::string& metric, double before, double after) {
    return history_of_levels(metric, {before, before, after, after}).steps.at(0).worse_by;
  };
  EXPECT_GT(worse_by("vision.recall", 0.8, 0.7), 1.0);
  EXPECT_LT(worse_by("vision.recall", 0.7, 0.8), -1.0);
  EXPECT_LT(worse_by("filters.ekf.anees", 5.0, 1.0), -1.0);
  EXPECT_GT(worse_by("vision.range_bias_m", 0.01, -0.02), 1.0);
  EXPECT_LT(std::abs(worse_by(kEkfAte, 1.0, 1.04)), 1.0);  // within 5 %
}

// Of something that never happened every event is too much. Mutation: a margin of 0 that divides to nothing.
TEST(History, OfWhatNeverHappenedHasNoMargin) {
  EXPECT_GT(history_of_levels("filters.ekf.failures", {0, 0, 1}).steps.at(0).worse_by, 1e9);
  EXPECT_EQ(history_of_levels("filters.ekf.failures", {0, 0, 0}).steps.size(), 0U);
}

// A bias is a share of the rms error. Mutation: of the bias itself (40 margins in place of 2).
TEST(History, TakesMarginsOfABiasFromItsRmsError) {
  const auto results = results_of({{"vision.range_bias_m", {0.001, 0.001, 0.005, 0.005}},
                                   {"vision.range_rms_m", {0.02, 0.02, 0.02, 0.02}}});
  const History history = history_of(results, {});
  EXPECT_NEAR(history.metrics.at(0).steps.at(0).worse_by, 0.004 / (0.1 * 0.02), 1e-9);
}

TEST(History, OfEqualResultsHasNoStep) {
  const History history =
      history_of(results_of({{kEkfAte, {1, 1, 1, 1}}, {"vision.recall", {1, 1, 1, 1}}}), {});
  EXPECT_EQ(history.changed, 0);
  EXPECT_TRUE(steps_of(history).empty());
  EXPECT_FALSE(ends_worse(history));
}

// Two hundred metrics that all change on 14 seeds: 200 / 2^13 is above 1 %. One alone is below.
// Mutation: no correction.
TEST(History, CorrectsForTheNumberOfMetricsThatChanged) {
  std::map<std::string, std::vector<double>> levels;
  for (int i = 0; i < 200; ++i) levels["filters.f" + std::to_string(i) + ".ate_rms_m"] = {1, 1, 2, 2};
  const History many = history_of(results_of(levels, 14), {});
  EXPECT_TRUE(steps_of(many).empty());
  EXPECT_EQ(many.changed, 200);
  EXPECT_EQ(many.fewest_seeds, 16);
  for (auto& [metric, level] : levels)
    if (metric != "filters.f7.ate_rms_m") level = {1, 1, 1, 1};
  const History one = history_of(results_of(levels, 14), {});
  EXPECT_EQ(one.changed, 1);
  ASSERT_EQ(steps_of(one).size(), 1U);
  EXPECT_EQ(steps_of(one)[0].step.p, std::ldexp(1.0, -13));
  EXPECT_EQ(steps_of(history_of(results_of(levels, 14), {.only = "*.f7.*"})).size(), 1U);
}

// Seeds stand in any order, and some are of one result alone. Mutations: values paired by their place in the
// file; means over all seeds of a result.
TEST(History, IsOfTheSeedsThatAllResultsHave) {
  std::vector<SeedTable> results = results_of({{kEkfAte, {1, 1, 1}}}, 10);
  std::ranges::reverse(results[1].seeds);
  std::ranges::reverse(results[1].metrics[kEkfAte]);
  results[2].seeds.push_back(77);
  results[2].metrics[kEkfAte].push_back(1000.0);
  const History history = history_of(results, {});
  EXPECT_EQ(history.seeds.size(), 10U);
  EXPECT_EQ(history.changed, 0);
  EXPECT_THAT(history.metrics.at(0).means, testing::Each(testing::DoubleNear(1.045, 1e-12)));
}

// Mutation: the step at its place among the results that have a value.
TEST(History, SkipsResultsWithoutAValue) {
  std::vector<SeedTable> results =
      results_of({{kEkfAte, {1, 5, 1, 2, 2}}, {"vision.recall", {1, 1, 1, 1, 1}}});
  results[1].metrics.erase(kEkfAte);
  results[4].metrics[kEkfAte][3] = kMissing;
  const History history = history_of(results, {});
  const MetricHistory& metric = history.metrics.at(0);
  EXPECT_TRUE(std::isnan(metric.means[1]));
  EXPECT_EQ(metric.seeds, 19);
  EXPECT_EQ(metric.lost, 1);
  ASSERT_EQ(metric.steps.size(), 1U);
  EXPECT_EQ(metric.steps[0].result, 3U);
  EXPECT_THAT(history_summary(history, 5), AllOf(HasSubstr("filters.ekf.ate_rms_m: left out 1 seed"),
                                                 HasSubstr("filters.ekf.ate_rms_m: no value in 1 result")));
}

// Filters without random numbers give the same on one log each time: many seeds are no proof of anything.
// Mutation: taken for 20 proofs (the changes of 1e-9 have a p-value then).
TEST(History, TakesChangesOfARepeatedLogAsTheyAre) {
  std::vector<SeedTable> results(4);
  const std::vector<double> levels = {1.0, 1.0, 1.0 + 1e-9, 2.0};
  for (std::size_t i = 0; i < 4; ++i) {
    results[i] = {.seeds = {0, 1, 2}, .metrics = {{kEkfAte, std::vector(3, levels[i])}}, .is_one_log = true};
  }
  const History history = history_of(results, {});
  const std::vector<HistoryStep>& steps = history.metrics.at(0).steps;
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_EQ(steps[0].result, 2U);
  EXPECT_EQ(steps[1].p, 0.0);
  EXPECT_EQ(history.changed, 0);
  EXPECT_THAT(step_table(history), HasSubstr("no chance in it"));
}

// Mutations: any step; the first one.
TEST(History, EndsWorseWhereTheLastStepIsForTheWorse) {
  EXPECT_TRUE(ends_worse(history_of(results_of({{kEkfAte, {1, 1, 2, 2}}}), {})));
  EXPECT_FALSE(ends_worse(history_of(results_of({{kEkfAte, {1, 1, 2, 2, 1, 1}}}), {})));
  EXPECT_FALSE(ends_worse(history_of(results_of({{kEkfAte, {1, 1, 1.04, 1.04}}}), {})));
  const HistorySettings narrow{.margins = {parse_margin("filters.*=1%")}};
  EXPECT_TRUE(ends_worse(history_of(results_of({{kEkfAte, {1, 1, 1.04, 1.04}}}), narrow)));
}

// Mutation: in the order of names.
TEST(HistoryReport, HasTheWorstStepFirst) {
  const auto results = results_of({{"filters.a.ate_rms_m", {1, 1, 0.5, 0.5}},
                                   {"filters.b.ate_rms_m", {1, 1, 1, 3}},
                                   {"vision.recall", {0.8, 0.79, 0.79, 0.79}}});
  const History history = history_of(results, {});
  const std::string table = step_table(history);
  const std::size_t worst = table.find("filters.b.ate_rms_m"), middle = table.find("vision.recall"),
                    best = table.find("filters.a.ate_rms_m");
  EXPECT_LT(worst, middle);
  EXPECT_LT(middle, best);
  EXPECT_THAT(table, testing::ContainsRegex("filters.b.ate_rms_m +3 to 4 +1.09 +3.29 +.200 % .*worse"));
  EXPECT_THAT(table, testing::ContainsRegex("filters.a.ate_rms_m +2 to 3 +1.09 +0.547 +-50 % .*better"));
  EXPECT_THAT(history_summary(history, 4),
              HasSubstr("3 metrics followed over 4 results on 20 seeds: 3 changed, 3 with a step"));
}

TEST(HistoryReport, IsForProgramsToo) {
  const History history = history_of(results_of({{kEkfAte, {1, 1, 2}}}, 10), {});
  const std::vector<std::string> places = {"a", "b", "c"};
  const auto json = history_json(history, {}, places);
  EXPECT_EQ(json["results"][2], "c");
  EXPECT_NEAR(json["metrics"][0]["means"][2].get<double>(), 2.09, 1e-12);
  EXPECT_EQ(json["metrics"][0]["steps"][0]["from_result"], 3);
  EXPECT_EQ(json["metrics"][0]["steps"][0]["is"], "worse");
}

// Mutation: no word of it.
TEST(HistoryReport, WarnsOfTooFewSeeds) {
  const History history = history_of(results_of({{kEkfAte, {1, 1, 2}}}, 5), {});
  EXPECT_TRUE(steps_of(history).empty());
  EXPECT_THAT(history_warning(history, {}),
              HasSubstr("warning: 5 seeds cannot tell 1 changed metric from chance "
                        "(alpha 0.01): 8 are the fewest that can"));
}

TEST(History, RefusesWhatCannotBeFollowed) {
  const auto refusal = [](std::vector<SeedTable> results, const HistorySettings& settings) {
    return [results = std::move(results), settings] { history_of(results, settings); };
  };
  const auto results = results_of({{kEkfAte, {1, 2}}});
  EXPECT_THAT(refusal({results[0]}, {}), ThrowsMessage<std::runtime_error>(HasSubstr("two results or more")));
  auto others = results;
  for (std::uint64_t& seed : others[1].seeds) seed += 1000;
  EXPECT_THAT(refusal(others, {}), ThrowsMessage<std::runtime_error>(HasSubstr("no seed in common")));
  EXPECT_THAT(refusal(results, {.only = "vision.*"}),
              ThrowsMessage<std::runtime_error>(HasSubstr("fits 'vision.*'")));
  EXPECT_THAT(refusal(results, {.margins = {parse_margin("filter.*=5%")}}),
              ThrowsMessage<std::runtime_error>(HasSubstr("--margin: no metric that is followed fits")));
}

}  // namespace
}  // namespace stereobench::harness
