#include "harness/regression/verdict.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "slam/math/elementary.h"
#include "slam/math/random.h"

namespace stereobench::harness {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
const char* const kAte = "filters.ekf.ate_rms_m";

SeedTable table_of(SeedMetrics metrics) {
  SeedTable table{.metrics = std::move(metrics)};
  for (std::size_t seed = 0; seed < table.metrics.begin()->second.size(); ++seed) table.seeds.push_back(seed);
  return table;
}

/// Errors of some seeds, whose worlds differ by a factor of 1.5 (one standard deviation), and how they come
/// out a second time: each off by `noise`, all by a factor.
struct Drawn {
  std::vector<double> first;
  std::vector<double> second;
};

Drawn draw(std::uint64_t key, std::size_t seeds, double factor, double noise) {
  slam::RandomStream random(key, slam::Stream::kOracle, seeds);
  Drawn drawn;
  for (std::size_t i = 0; i < seeds; ++i) {
    drawn.first.push_back(slam::exponential(0.4 * random.normal()));
    drawn.second.push_back(factor * drawn.first.back() * slam::exponential(noise * random.normal()));
  }
  return drawn;
}

MetricVerdict verdict_of(const std::vector<double>& first, const std::vector<double>& second,
                         const std::string& metric = kAte) {
  return compare_results(table_of({{metric, first}}), table_of({{metric, second}}), {}).metrics.at(0);
}

TEST(Verdict, EqualBytesPass) {
  const Drawn drawn = draw(0, 20, 1.0, 0.0);
  const MetricVerdict verdict = verdict_of(drawn.first, drawn.first);
  EXPECT_EQ(verdict.verdict, Verdict::kPass);
  EXPECT_TRUE(verdict.equal);
}

// Worlds differ by more than the change: pairs tell it. Mutation: the first minus the second.
TEST(Verdict, SeesATwentyPercentLargerErrorOnTwentySeeds) {
  int seen = 0;
  for (std::uint64_t key = 0; key < 50; ++key) {
    const Drawn drawn = draw(key, 20, 1.2, 0.1);
    seen += verdict_of(drawn.first, drawn.second).verdict == Verdict::kRegressed ? 1 : 0;
    EXPECT_NE(verdict_of(drawn.second, drawn.first).verdict, Verdict::kRegressed);
  }
  EXPECT_GE(seen, 48);
}

// The way back of a regression is an improvement. Mutation: INCONCLUSIVE for all that is better.
TEST(Verdict, OfTheWayBackIsTheOpposite) {
  const Drawn drawn = draw(3, 20, 1.5, 0.1);
  EXPECT_EQ(verdict_of(drawn.first, drawn.second).verdict, Verdict::kRegressed);
  EXPECT_EQ(verdict_of(drawn.second, drawn.first).verdict, Verdict::kImproved);
}

// 300 comparisons of 5 metrics each, in which nothing but chance changed. At a family-wise level of 1 % there
// are 3 false alarms, 1.7 of standard deviation; the margins leave fewer. Mutation: no correction (Holm).
TEST(Verdict, RaisesHardlyAFalseAlarm) {
  int alarms = 0;
  for (std::uint64_t key = 0; key < 300; ++key) {
    SeedMetrics first, second;
    for (std::uint64_t metric = 0; metric < 5; ++metric) {
      const Drawn drawn = draw(1000 + 100 * key + metric, 20, 1.0, 0.3);
      const std::string name = "filters.f" + std::to_string(metric) + ".ate_rms_m";
      first[name] = drawn.first;
      second[name] = drawn.second;
    }
    const ResultComparison comparison = compare_results(table_of(first), table_of(second), {});
    alarms += comparison.has(Verdict::kRegressed) || comparison.has(Verdict::kImproved) ? 1 : 0;
  }
  EXPECT_LE(alarms, 8);
}

// Mutation: passing what is not significantly worse.
TEST(Verdict, IsInconclusiveUntilTheIntervalIsWithinTheMargin) {
  const Drawn few = draw(7, 10, 1.0, 0.1);
  const MetricVerdict verdict = verdict_of(few.first, few.second);
  ASSERT_EQ(verdict.verdict, Verdict::kInconclusive);
  ASSERT_TRUE(verdict.more_seeds);
  const auto enough = static_cast<std::size_t>(3 * (10 + *verdict.more_seeds));
  const Drawn many = draw(7, enough, 1.0, 0.1);
  EXPECT_EQ(verdict_of(many.first, many.second).verdict, Verdict::kPass);
}

// Of eight metrics that all doubled on eight seeds none can be significant: 8 / 2^7 is above 1 %.
// Mutation: a need that the interval alone tells.
TEST(Verdict, SaysHowManySeedsASmallEnoughPNeeds) {
  SeedMetrics first, second;
  for (int metric = 0; metric < 8; ++metric) {
    const std::string name = "filters.f" + std::to_string(metric) + ".ate_rms_m";
    first[name] = std::vector(8, 1.0);
    second[name] = {2.0, 2.01, 2.02, 2.03, 2.04, 2.05, 2.06, 2.07};
  }
  const ResultComparison comparison = compare_results(table_of(first), table_of(second), {});
  for (const MetricVerdict& metric : comparison.metrics) {
    EXPECT_EQ(metric.verdict, Verdict::kInconclusive);
    EXPECT_EQ(metric.more_seeds, 3);  // 8 / 2^10 is below 1 %
  }
}

// Mutation: what is left is compared as if nothing were lost.
TEST(Verdict, OfAMetricThatLostSomeOfItsValues) {
  std::vector<double> first(10, 1.0);
  std::vector<double> second = first;
  second[3] = second[8] = kNone;
  const MetricVerdict lost = verdict_of(first, second);
  EXPECT_EQ(lost.verdict, Verdict::kVanished);
  EXPECT_EQ(lost.lost, 2);
  EXPECT_EQ(verdict_of(second, first).verdict, Verdict::kPass);
}

// NIS of 0.75 and 1.25 in turn is right on average, and 1.1 on all seeds is not. Mutation: the mean distance
// from 1 in place of the distance of the mean.
TEST(Verdict, LooksAtTheMeanThatIsToBeNearOne) {
  std::vector<double> first, second;
  for (int i = 0; i < 40; ++i) {
    first.push_back(i % 2 == 0 ? 0.75 : 1.25);
    second.push_back(first.back() + 0.3);
  }
  EXPECT_EQ(verdict_of(first, second, "filters.ekf.consistency.nis.per_run").verdict, Verdict::kRegressed);
  EXPECT_GT(verdict_of(first, std::vector(40, 1.1), "filters.ekf.consistency.nis.per_run").change, 0.0);
}

// Filters without random numbers give the same on one log each time: more seeds would tell nothing.
// Mutation: ten times the same for ten proofs.
TEST(Verdict, TakesARepeatedLogForOneLog) {
  SeedTable first = table_of({{kAte, std::vector(3, 1.0)}, {"batch.ate_rms_m", {1.0, 1.1, 1.2}}});
  SeedTable second = table_of({{kAte, std::vector(3, 1.2)}, {"batch.ate_rms_m", {1.3, 1.4, 1.3}}});
  first.is_one_log = second.is_one_log = true;
  const ResultComparison comparison = compare_results(first, second, {});
  EXPECT_EQ(comparison.metrics[0].metric, kAte);
  EXPECT_EQ(comparison.metrics[0].verdict, Verdict::kRegressed);
  EXPECT_EQ(comparison.metrics[0].test, ChangeTest::kExact);
  EXPECT_EQ(comparison.metrics[1].verdict, Verdict::kInconclusive);
  EXPECT_EQ(comparison.changed, 1);
}

// Of four seeds no ranks are improbable enough, but 40 balls lost and none won are. Mutation: counts that are
// not read.
TEST(Verdict, OfARateIsByItsCounts) {
  const SeedTable first = table_of({{"vision.recall", std::vector(4, 1.0)}});
  const SeedTable second = table_of({{"vision.recall", {0.9, 0.91, 0.89, 0.9}}});
  EXPECT_EQ(compare_results(first, second, {}).metrics[0].verdict, Verdict::kInconclusive);
  const ResultComparison counted = compare_results(first, second, {}, {{"vision.recall", {40, 0}}});
  EXPECT_EQ(counted.metrics[0].verdict, Verdict::kRegressed);
  EXPECT_EQ(counted.metrics[0].test, ChangeTest::kMcnemar);
}

// Twelve balls were lost, and with them fifty errors of filters changed a little: the loss has a share of
// alpha of its own. Mutation: one family.
TEST(Verdict, OfDetectionsIsNotDrownedByManyMetricsOfFilters) {
  SeedMetrics first, second;
  for (int i = 0; i < 50; ++i) {
    const Drawn drawn = draw(static_cast<std::uint64_t>(i), 20, 1.0, 0.1);
    first[fmt::format("filters.f{}.ate_rms_m", i)] = drawn.first;
    second[fmt::format("filters.f{}.ate_rms_m", i)] = drawn.second;
  }
  first["vision.recall"] = std::vector<double>(20, 1.0);
  second["vision.recall"] = std::vector<double>(20, 1.0);
  for (std::size_t seed = 0; seed < 12; ++seed) second["vision.recall"][seed] = 29.0 / 30.0;
  const ResultComparison comparison = compare_results(
      table_of(first), table_of(second), {}, {{"vision.recall", {{.worse = 12, .total = 600}, true}}});
  EXPECT_EQ(comparison.metrics.front().metric, "vision.recall");
  EXPECT_EQ(comparison.metrics.front().verdict, Verdict::kRegressed);
  EXPECT_NEAR(comparison.metrics.front().p_holm, 2.0 * std::ldexp(1.0, -11), 1e-12);
}

// The mean of the seeds' rates is not the rate of all balls. Mutation: the interval of counts in any case.
TEST(Verdict, OfSeedsWithFewBallsIsNotThatOfAllBalls) {
  std::vector<double> first(20, 1.0), second(20, 1.0);
  second[0] = 0.0;  // its only ball; the others have 200 each
  const ResultComparison comparison =
      compare_results(table_of({{"vision.recall", first}}), table_of({{"vision.recall", second}}), {},
                      {{"vision.recall", {{.worse = 1, .total = 3801}, true}}});
  EXPECT_NE(comparison.metrics.front().verdict, Verdict::kPass);
}

TEST(Verdict, RefusesAMarginOfNoMetric) {
  const SeedTable table = table_of({{kAte, {1.0, 2.0}}, {"vision.visible", {3.0, 4.0}}});
  const ResultComparison comparison = compare_results(table, table, {});
  EXPECT_NO_THROW(check_margins(comparison, {parse_margin("filters.*=5%")}));
  EXPECT_THAT([&] { check_margins(comparison, {parse_margin("filter.*=5%")}); },
              ThrowsMessage<std::runtime_error>(HasSubstr("no metric that is judged fits 'filter.*'")));
}

TEST(Verdict, OfAMetricThatOneResultLacks) {
  const SeedTable first = table_of({{"filters.a.ate_rms_m", {1.0, 2.0}}, {"batch.failures", {0.0, 0.0}}});
  const SeedTable second = table_of({{"filters.b.ate_rms_m", {1.0, kNone}}, {"batch.failures", {0.0, 0.0}}});
  const ResultComparison comparison = compare_results(first, second, {});
  ASSERT_EQ(comparison.metrics.size(), 3U);
  EXPECT_EQ(comparison.metrics[0].metric, "filters.a.ate_rms_m");
  EXPECT_EQ(comparison.metrics[0].verdict, Verdict::kVanished);
  EXPECT_EQ(comparison.metrics[1].verdict, Verdict::kNew);
  EXPECT_EQ(comparison.metrics[2].verdict, Verdict::kPass);
}

TEST(Verdict, LeavesSeedsOutThatTheFirstResultHasNoValueOf) {
  const MetricVerdict verdict = verdict_of({1.0, 2.0, kNone}, {1.0, 2.0, 3.0});
  EXPECT_EQ(verdict.pairs, 2);
  EXPECT_EQ(verdict.lost, 0);
  EXPECT_EQ(verdict.verdict, Verdict::kPass);
}

// Mutation: by place in place of by number.
TEST(Verdict, PairsValuesByTheirSeed) {
  const SeedTable first{.seeds = {4, 7, 9}, .metrics = {{kAte, {0.4, 0.7, 0.9}}}};
  const SeedTable second{.seeds = {9, 3, 4}, .metrics = {{kAte, {0.9, 0.3, 0.4}}}};
  const ResultComparison comparison = compare_results(first, second, {});
  EXPECT_THAT(comparison.seeds, ElementsAre(4U, 9U));
  EXPECT_TRUE(comparison.metrics.at(0).equal);
}

TEST(Verdict, NeedsSeedsAndMetricsInCommon) {
  const SeedTable first{.seeds = {1}, .metrics = {{kAte, {0.4}}}};
  const SeedTable second{.seeds = {2}, .metrics = {{kAte, {0.4}}}};
  EXPECT_THAT([&] { compare_results(first, second, {}); },
              ThrowsMessage<std::runtime_error>(HasSubstr("no seed in common")));
  const SeedTable seen = table_of({{"vision.visible", {3.0}}});
  EXPECT_THAT(
      [&] {
        compare_results(seen, table_of({{"vision.visible", {4.0}}}), {});
      },
      ThrowsMessage<std::runtime_error>(HasSubstr("is neither better nor worse")));
  EXPECT_THAT([&] { compare_results(first, first, {.only = {"vision.*"}}); },
              ThrowsMessage<std::runtime_error>(HasSubstr("no metric fits 'vision.*'")));
}

// How many balls there were to find is no merit: it says that the worlds are others.
TEST(Verdict, TellsNumbersThatAreNeitherGoodNorBadAside) {
  const SeedTable first = table_of({{"vision.visible", {3.0, 4.0}}, {"vision.recall", {1.0, 1.0}}});
  const SeedTable second = table_of({{"vision.visible", {3.0, 5.0}}, {"vision.recall", {1.0, 1.0}}});
  const ResultComparison comparison = compare_results(first, second, {});
  EXPECT_THAT(comparison.not_judged, ElementsAre("vision.visible"));
  EXPECT_EQ(comparison.metrics.size(), 1U);
}

}  // namespace
}  // namespace stereobench::harness
