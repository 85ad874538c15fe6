#include "harness/statistics/paired.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "slam/math/random.h"

namespace stereobench::harness {
namespace {

// Another route: all 2^n choices of signs, one by one. Mutations: the count of subsets off by one rank, one
// side in place of two, ranks of the wrong order.
TEST(Wilcoxon, CountsAllSigns) {
  slam::RandomStream random(3, slam::Stream::kWorld);
  for (std::size_t n = 1; n <= 10; ++n) {
    std::vector<double> differences;
    std::vector<std::size_t> rank_of;
    for (std::size_t i = 0; i < n; ++i) differences.push_back(random.normal() + 0.5);
    double observed = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      std::size_t rank = 1;
      for (const double other : differences) rank += std::abs(other) < std::abs(differences[i]) ? 1U : 0U;
      rank_of.push_back(rank);
      if (differences[i] > 0.0) observed += static_cast<double>(rank);
    }
    const double half = static_cast<double>(n * (n + 1)) / 4.0;
    int as_lopsided = 0;
    for (unsigned signs = 0; signs < (1U << n); ++signs) {
      double sum = 0.0;
      for (std::size_t i = 0; i < n; ++i)
        if ((signs >> i & 1U) != 0) sum += static_cast<double>(rank_of[i]);
      as_lopsided += std::abs(sum - half) >= std::abs(observed - half) ? 1 : 0;
    }
    EXPECT_NEAR(wilcoxon_signed_rank(differences), std::ldexp(as_lopsided, -static_cast<int>(n)), 1e-12);
  }
}

// Figures of scipy.stats.wilcoxon (1.10), exact and corrected; with ties 508 of all 2^12 choices of signs.
TEST(Wilcoxon, AgreesWithAnotherImplementation) {
  const std::vector<double> depression = {0.952, -0.147, 1.022, 0.43, 0.62, 0.59, 0.49, -0.08, 0.01};
  EXPECT_NEAR(wilcoxon_signed_rank(depression), 0.0390625, 1e-12);
  const std::vector<double> ties = {1, 1, -1, 2, 2, -3, 4, 4, 5, 5, -6, 7};
  EXPECT_NEAR(wilcoxon_signed_rank(ties), 508.0 / 4096.0, 1e-12);
  EXPECT_NEAR(wilcoxon_signed_rank(std::vector<double>(5, 2.0)), 0.0625, 1e-12);
  std::vector<double> many;
  for (int i = 0; i < 80; ++i) many.push_back((i % 7 - 2.3) * (1.0 + 0.01 * i));
  EXPECT_NEAR(wilcoxon_signed_rank(many), 0.012208488094030289, 1e-9);
}

// Of 1,000 comparisons of nothing 5 % fall below 0.05; 2.2 % to 7.8 % covers four standard deviations.
TEST(Wilcoxon, RarelySeesADifferenceWhereThereIsNone) {
  slam::RandomStream random(4, slam::Stream::kWorld);
  for (const std::size_t n : {20U, 100U}) {
    int below = 0;
    for (int trial = 0; trial < 1000; ++trial) {
      std::vector<double> differences(n);
      for (double& difference : differences) difference = random.normal();
      below += wilcoxon_signed_rank(differences) < 0.05 ? 1 : 0;
    }
    EXPECT_NEAR(below, 50, 28) << n;
  }
}

TEST(Wilcoxon, NothingDiffersIsOne) {
  EXPECT_EQ(wilcoxon_signed_rank({}), 1.0);
  EXPECT_EQ(wilcoxon_signed_rank(std::vector<double>(30, 0.0)), 1.0);
}

// Of 10 changes 1 went one way: 2 (1 + 10) / 2^10. Mutation: one side alone.
TEST(Mcnemar, CountsAllWaysThatAreAsLopsided) {
  EXPECT_NEAR(mcnemar({9, 1}), 22.0 / 1024.0, 1e-15);
  EXPECT_NEAR(mcnemar({1, 9}), 22.0 / 1024.0, 1e-15);
  EXPECT_NEAR(mcnemar({20, 0}) / std::ldexp(1.0, -19), 1.0, 1e-9);
  EXPECT_EQ(mcnemar({5, 5}), 1.0);
  EXPECT_EQ(mcnemar({}), 1.0);
}

// Mutation: the second minus the first.
TEST(ComparePaired, TakesDifferencesSeedBySeedAndLeavesOutFailures) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const PairedDifference pair =
      compare_paired(std::vector<double>{1.0, 2.0, nan, 5.0}, std::vector<double>{2.0, 4.0, 1.0, 8.0});
  EXPECT_EQ(pair.difference.count, 3);
  EXPECT_DOUBLE_EQ(pair.difference.mean, -2.0);
  EXPECT_DOUBLE_EQ(pair.p_value, 0.25);  // 2 of the 8 choices of signs
  EXPECT_THROW(compare_paired(std::vector<double>{1.0}, {}), std::invalid_argument);
}

// The interval ends where the score test of that difference is at its level; of no difference that is
// McNemar's statistic. Mutations: the sign of a count; the variance without the share of those that got
// better.
TEST(PairedShareInterval, EndsAtZeroWhereMcnemarsStatisticIsAtItsLevel) {
  constexpr double kNormalOf95 = 1.959963984540054;
  for (const auto& [worse, better] : {std::pair(20L, 5L), {7L, 1L}, {40L, 30L}}) {
    const double z = static_cast<double>(worse - better) / std::sqrt(static_cast<double>(worse + better));
    const Interval interval = paired_share_interval({worse, better, 300}, 0.95);
    EXPECT_EQ(interval.low > 0.0, z > kNormalOf95) << worse << " " << better;
    const Interval other = paired_share_interval({better, worse, 300}, 0.95);
    EXPECT_NEAR(other.low, -interval.high, 1e-12);
    EXPECT_NEAR(other.high, -interval.low, 1e-12);
  }
}

// Without a difference it is Wilson's: z^2 / (n + z^2). Mutation: a normal's quantile of one side.
TEST(PairedShareInterval, IsNotEmptyWhereNothingDiffers) {
  const double z2 = 1.959963984540054 * 1.959963984540054;
  const Interval interval = paired_share_interval({0, 0, 100}, 0.95);
  EXPECT_NEAR(interval.high, z2 / (100.0 + z2), 1e-9);
  EXPECT_NEAR(interval.low, -interval.high, 1e-9);
}

// Shares of 3 % and 1 % of 600: of 4,000 intervals of 99 % between 19 and 64 miss (0.4 % to 1.6 %).
// Mutation: the variance without the share of those that got better.
TEST(PairedShareInterval, CoversTheDifferenceAsOftenAsItSays) {
  slam::RandomStream random(4, slam::Stream::kResample);
  int missed = 0;
  for (int study = 0; study < 4000; ++study) {
    PairedCount count{.total = 600};
    for (int i = 0; i < 600; ++i) {
      const double chance = random.uniform();
      count.worse += chance < 0.03 ? 1 : 0;
      count.better += chance > 0.99 ? 1 : 0;
    }
    const Interval interval = paired_share_interval(count, 0.99);
    missed += interval.low > 0.02 || interval.high < 0.02 ? 1 : 0;
  }
  EXPECT_GE(missed, 19);
  EXPECT_LE(missed, 64);
}

}  // namespace
}  // namespace stereobench::harness
