#include "harness/statistics/bootstrap.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "slam/math/elementary.h"
#include "slam/math/random.h"

namespace stereobench::harness {
namespace {

enum class Law { kNormal, kExponential };

/// Values of mean 1.
std::vector<double> sample(Law law, std::size_t count, slam::RandomStream& random) {
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i)
    values.push_back(law == Law::kNormal ? 1.0 + random.normal() : -slam::logarithm(1.0 - random.uniform()));
  return values;
}

/// How many of 200 intervals of 95 % hold the true mean.
int covered(Law law, std::size_t count) {
  int covered = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    slam::RandomStream random(seed, slam::Stream::kOracle, count);
    const Interval interval = mean_interval(sample(law, count, random), 0.95);
    covered += interval.low <= 1.0 && 1.0 <= interval.high ? 1 : 0;
  }
  return covered;
}

// Of 200 intervals 190 hold the mean, with a standard deviation of 3.1; of few skewed values somewhat fewer.
// Mutations: a level of one side; no widening for small samples.
TEST(MeanInterval, HoldsTheMeanAsOftenAsItSays) {
  for (const std::size_t count : {5U, 10U, 20U, 80U}) {
    EXPECT_GE(covered(Law::kNormal, count), 181) << count;
    EXPECT_LE(covered(Law::kNormal, count), 199) << count;
  }
  EXPECT_GE(covered(Law::kExponential, 20), 176);
  EXPECT_GE(covered(Law::kExponential, 80), 181);
}

// Errors of positive numbers are skewed: the mean may be further above than below. Mutation: without the
// acceleration it is 1.2 times as far.
TEST(MeanInterval, ReachesFurtherToTheSideOfTheLongTail) {
  slam::RandomStream random(1, slam::Stream::kOracle);
  const std::vector<double> values = sample(Law::kExponential, 80, random);
  double mean = 0.0;
  for (const double value : values) mean += value / 80.0;
  const Interval interval = mean_interval(values, 0.99);
  EXPECT_GT(interval.high - mean, 1.3 * (mean - interval.low));
}

TEST(MeanInterval, FollowsShiftsAndScales) {
  slam::RandomStream random(2, slam::Stream::kOracle);
  const std::vector<double> values = sample(Law::kExponential, 20, random);
  std::vector<double> moved;
  for (const double value : values) moved.push_back(5.0 - 3.0 * value);
  const Interval one = mean_interval(values, 0.9);
  const Interval other = mean_interval(moved, 0.9);
  EXPECT_NEAR(other.high, 5.0 - 3.0 * one.low, 0.02);
  EXPECT_NEAR(other.low, 5.0 - 3.0 * one.high, 0.02);
}

TEST(MeanInterval, IsAPointWhereAllValuesAreOne) {
  const Interval interval = mean_interval(std::vector(12, 0.3), 0.99);
  EXPECT_EQ(interval.low, 0.3);
  EXPECT_EQ(interval.high, 0.3);
}

TEST(MeanInterval, OfOneValueSaysNothing) {
  const Interval interval = mean_interval(std::vector{0.3}, 0.99);
  EXPECT_TRUE(std::isinf(interval.low) && std::isinf(interval.high));
}

// Table 26.10 of Abramowitz and Stegun.
TEST(StudentT, QuantilesAreThoseOfTheTables) {
  EXPECT_NEAR(student_t_quantile(0.95, 1), 12.706, 5e-4);
  EXPECT_NEAR(student_t_quantile(0.99, 9), 3.250, 5e-4);
  EXPECT_NEAR(student_t_quantile(0.95, 120), 1.980, 5e-4);
}

}  // namespace
}  // namespace stereobench::harness
