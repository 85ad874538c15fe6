#include "harness/response/seed_resampling.h"

#include <cmath>
#include <limits>
#include <numeric>

#include <gtest/gtest.h>

#include "slam/math/random.h"

namespace stereobench::harness {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

// 2,000 draws of 10 seeds: a seed is drawn once on average, with a variance of 0.9; the mean of its 2,000
// numbers is known to 0.021, and four times that is allowed. Mutation: the last seed never drawn.
TEST(DrawnSeeds, AreAsManyAsThereAreAndAnyOfThem) {
  const std::vector<SeedCounts> draws = drawn_seeds(10);
  ASSERT_EQ(draws.size(), 2000U);
  SeedCounts sums(10, 0.0);
  for (const SeedCounts& counts : draws) {
    EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), 0.0), 10.0);
    for (std::size_t i = 0; i < 10; ++i) sums[i] += counts[i] / 2000.0;
  }
  for (const double sum : sums) EXPECT_NEAR(sum, 1.0, 0.085);
  EXPECT_EQ(draws, drawn_seeds(10));
}

// Student's t of 9 degrees is 2.262 for 95 %; times sqrt(10 / 9) a normal has 0.86 % beyond on each side.
// Mutations: no widening; a level of one side.
TEST(PercentileInterval, LeavesOutWhatStudentLeavesOut) {
  std::vector<double> drawn(10001);
  std::iota(drawn.begin(), drawn.end(), 0.0);
  const Interval interval = percentile_interval(drawn, 10, 0.95);
  EXPECT_NEAR(interval.low, 86.0, 3.0);
  EXPECT_EQ(interval.low + interval.high, 10000.0);
}

TEST(PercentileInterval, MayBeEndlessAndLeavesOutWhatIsNoNumber) {
  std::vector<double> drawn(1000, 1.0);
  for (std::size_t i = 0; i < 100; ++i) drawn[7 * i] = kUnbounded;
  drawn[1] = std::nan("");
  const Interval interval = percentile_interval(drawn, 10, 0.95);
  EXPECT_EQ(interval.low, 1.0);
  EXPECT_EQ(interval.high, kUnbounded);
  EXPECT_TRUE(std::isnan(percentile_interval({std::nan("")}, 10, 0.95).low));
}

// The mean of 10 normals has an error of 1 / sqrt(10); so has the mean of drawn ones, over many samples.
// Mutation: the sd of the draws as it is is 5 % less.
TEST(DrawnError, IsThatOfAMean) {
  slam::RandomStream random(3, slam::Stream::kOracle);
  constexpr int kSamples = 400;
  double mean_square = 0.0;
  const std::vector<SeedCounts> draws = drawn_seeds(10);
  for (int sample = 0; sample < kSamples; ++sample) {
    SeedCounts values(10);
    for (double& value : values) value = random.normal();
    std::vector<double> means;
    for (const SeedCounts& counts : draws)
      means.push_back(std::inner_product(counts.begin(), counts.end(), values.begin(), 0.0) / 10.0);
    mean_square += drawn_error(means, 10) * drawn_error(means, 10) / kSamples;
  }
  EXPECT_NEAR(mean_square, 0.1, 0.1 * 4.0 * std::sqrt(2.0 / 9.0 / kSamples) / 2.0);
  EXPECT_TRUE(std::isnan(drawn_error({1.0, kUnbounded}, 10)));
}

}  // namespace
}  // namespace stereobench::harness
