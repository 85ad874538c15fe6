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

/// The interval of a mean: of the change from nothing to these values.
Interval mean_interval(const std::vector<double>& values, double level) {
  const std::vector<double> nothing(values.size(), 0.0);
  return change_interval(nothing, values, level, [](double first, double second) { return second - first; });
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
  for (const std::size_t count : {5U, 12U}) {
    const Interval interval = mean_interval(std::vector(count, 0.3), 0.99);
    EXPECT_NEAR(interval.low, 0.3, 1e-12);
    EXPECT_NEAR(interval.high, 0.3, 1e-12);
  }
}

TEST(MeanInterval, OfOneValueSaysNothing) {
  const Interval interval = mean_interval(std::vector{0.3}, 0.99);
  EXPECT_TRUE(std::isinf(interval.low) && std::isinf(interval.high));
}

// What pairs have in common cancels. Mutation: both drawn by themselves.
TEST(ChangeInterval, IsOfPairs) {
  slam::RandomStream random(3, slam::Stream::kOracle);
  std::vector<double> first, second;
  for (int i = 0; i < 20; ++i) {
    first.push_back(10.0 * random.normal());
    second.push_back(first.back() + 1.0 + 0.1 * random.normal());
  }
  const Interval interval = change_interval(first, second, 0.99, [](double a, double b) { return b - a; });
  EXPECT_GT(interval.low, 0.85);
  EXPECT_LT(interval.high, 1.15);
}

// By the rule for products of small errors: the ratio of means 4 and 2, each off by 0.1 and paired at random.
// Mutation: the spread of the changes in place of their error.
TEST(StandardError, IsThatOfPropagation) {
  slam::RandomStream random(4, slam::Stream::kOracle);
  std::vector<double> first, second;
  for (int i = 0; i < 400; ++i) {
    first.push_back(2.0 + 2.0 * random.normal());
    second.push_back(4.0 + 2.0 * random.normal());
  }
  const double error = standard_error(first, second, [](double a, double b) { return b / a; });
  EXPECT_NEAR(error, std::sqrt(0.05 * 0.05 + 0.1 * 0.1), 0.02);
}

}  // namespace
}  // namespace stereobench::harness
