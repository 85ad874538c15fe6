#include "harness/regression/verdict.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

// Worlds differ by more than the change: pairs tell it. Mutations: compared unpaired, 12 of 50 are seen; the
// wrong way round, all are IMPROVED.
TEST(Verdict, SeesATwentyPercentLargerErrorOnTwentySeeds) {
  int seen = 0;
  for (std::uint64_t key = 0; key < 50; ++key) {
    const Drawn drawn = draw(key, 20, 1.2, 0.1);
    seen += verdict_of(drawn.first, drawn.second).verdict == Verdict::kRegressed ? 1 : 0;
    EXPECT_NE(verdict_of(drawn.second, drawn.first).verdict, Verdict::kRegressed);
  }
  EXPECT_GE(seen, 48);
}

// The way back of a regression is an improvement. Mutation: margins of one side.
TEST(Verdict, OfTheWayBackIsTheOpposite) {
  const Drawn drawn = draw(3, 20, 1.5, 0.1);
  EXPECT_EQ(verdict_of(drawn.first, drawn.second).verdict, Verdict::kRegressed);
  EXPECT_EQ(verdict_of(drawn.second, drawn.first).verdict, Verdict::kImproved);
}

// 300 comparisons of 5 metrics each, in which nothing but chance changed. At a family-wise level of 1 %
// there are 3 false alarms, 1.7 of standard deviation; the margins leave fewer. Mutations: no correction
// (Holm), or no margin and no interval: above 9.
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

// A filter that is lost on some seeds has no error there; what it has elsewhere is compared.
TEST(Verdict, LeavesSeedsOutThatOneResultHasNoValueOf) {
  const MetricVerdict verdict = verdict_of({1.0, 2.0, kNone}, {1.0, kNone, 3.0});
  EXPECT_EQ(verdict.pairs, 1);
  EXPECT_FALSE(verdict.equal);
  EXPECT_EQ(verdict.verdict, Verdict::kInconclusive);
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
  EXPECT_THAT([&] { compare_results(first, first, {.only = "vision.*"}); },
              ThrowsMessage<std::runtime_error>(HasSubstr("no metric fits 'vision.*'")));
}

// How many balls there were to find is no merit: it says that the worlds are others.
TEST(Verdict, TellsNumbersThatAreNeitherGoodNorBadAside) {
  const SeedTable first = table_of({{"vision.visible", {3.0, 4.0}}, {"vision.recall", {1.0, 1.0}}});
  const SeedTable second = table_of({{"vision.visible", {3.0, 5.0}}, {"vision.recall", {1.0, 1.0}}});
  const ResultComparison comparison = compare_results(first, second, {});
  EXPECT_THAT(comparison.conditions, ElementsAre("vision.visible"));
  EXPECT_EQ(comparison.metrics.size(), 1U);
}

}  // namespace
}  // namespace stereobench::harness
