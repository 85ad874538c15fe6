#include "harness/response/floor_and_slope.h"

#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "slam/math/elementary.h"
#include "slam/math/random.h"

namespace stereobench::harness {
namespace {

const std::vector<double> kSixLevels = {0.0, 0.1, 0.2, 0.4, 0.8, 1.6};

std::vector<double> squares_of(const FloorAndSlope& law, const std::vector<double>& levels) {
  std::vector<double> squares;
  for (const double level : levels) squares.push_back(law.at(level) * law.at(level));
  return squares;
}

FloorAndSlope fit(const std::vector<double>& levels, const std::vector<double>& squares) {
  return fit_floor_and_slope(levels, squares, std::vector<double>(levels.size(), 1.0));
}

/// The deviance of the quasi-likelihood, by its definition.
double deviance(const FloorAndSlope& law, const std::vector<double>& levels,
                const std::vector<double>& squares, const std::vector<double>& weights) {
  double sum = 0.0;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const double ratio = squares[i] / (law.at(levels[i]) * law.at(levels[i]));
    sum += weights[i] * (ratio - 1.0 - slam::logarithm(ratio));
  }
  return sum;
}

TEST(FloorAndSlope, FindsALawThatHolds) {
  for (const FloorAndSlope law : {FloorAndSlope{.floor = 0.3, .slope = 1.0},
                                  {.floor = 1e-4, .slope = 2.0},
                                  {.floor = 5.0, .slope = 0.01},
                                  {.floor = 3e-5, .slope = 4e-4}}) {
    const FloorAndSlope found = fit(kSixLevels, squares_of(law, kSixLevels));
    EXPECT_NEAR(found.floor / law.floor, 1.0, 1e-6);
    EXPECT_NEAR(found.slope / law.slope, 1.0, 1e-4);  // 5 m hide 0.016 m but for a part in 10^5
  }
}

TEST(FloorAndSlope, KneeIsWhereTheSensorCostsAsMuchAsAllElse) {
  const FloorAndSlope law = {.floor = 0.3, .slope = 1.5};
  EXPECT_DOUBLE_EQ(law.knee(), 0.2);
  EXPECT_DOUBLE_EQ(law.at(law.knee()), 0.3 * std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(law.at(0.0), 0.3);
  EXPECT_TRUE(std::isinf(FloorAndSlope({.floor = 0.3, .slope = 0.0}).knee()));
}

// The least deviance among all laws about the one that was found. Mutations: absolute deviations in place of
// relative ones; weights that are left out.
TEST(FloorAndSlope, HasTheLeastDeviance) {
  slam::RandomStream random(1, slam::Stream::kOracle);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<double> squares = squares_of({.floor = 0.3, .slope = 1.0}, kSixLevels);
    std::vector<double> weights;
    for (double& square : squares) {
      square *= slam::exponential(0.8 * random.normal());
      weights.push_back(1.0 + 9.0 * random.uniform());
    }
    const FloorAndSlope found = fit_floor_and_slope(kSixLevels, squares, weights);
    const double least = deviance(found, kSixLevels, squares, weights);
    for (const double floor : {0.98, 1.0, 1.02})
      for (const double slope : {0.98, 1.0, 1.02}) {
        const FloorAndSlope other = {.floor = found.floor * floor, .slope = found.slope * slope};
        EXPECT_GE(deviance(other, kSixLevels, squares, weights), least - 1e-12) << floor << " " << slope;
      }
  }
}

// Mutation: a floor below 0 taken for one of its size.
TEST(FloorAndSlope, HasNoFloorWhereErrorsGrowFasterThanALine) {
  const std::vector<double> levels = {0.1, 0.2, 0.4};
  const FloorAndSlope found = fit(levels, {0.01, 0.05, 0.3});
  EXPECT_EQ(found.floor, 0.0);
  EXPECT_EQ(found.knee(), 0.0);
  EXPECT_NEAR(found.slope, std::sqrt((1.0 + 1.25 + 1.875) / 3.0), 1e-9);  // the mean of square / level^2
}

TEST(FloorAndSlope, HasNoSlopeWhereErrorsDoNotGrow) {
  const FloorAndSlope found = fit(kSixLevels, {1.2, 1.0, 1.0, 1.0, 1.0, 0.8});
  EXPECT_EQ(found.slope, 0.0);
  EXPECT_DOUBLE_EQ(found.floor, 1.0);
}

// Far above all levels the score is rounding alone, whose sign changes from call to call. Mutation: the score
// at the ends computed again from their logarithms.
TEST(FloorAndSlope, FindsALawWhereErrorsHardlyGrow) {
  slam::RandomStream random(2, slam::Stream::kOracle);
  for (int trial = 0; trial < 2000; ++trial) {
    const double growth = slam::exponential(-28.0 + 14.0 * random.uniform());  // 1e-12 to 1e-6
    std::vector<double> squares;
    for (const double level : kSixLevels) squares.push_back(1.0 + growth * (level + 0.2 * random.normal()));
    const FloorAndSlope found = fit(kSixLevels, squares);
    EXPECT_NEAR(found.floor, 1.0, 1e-5);
    EXPECT_LT(found.slope, 1e-2);
  }
}

// Mutation: a level of weight 0 kept (its NaN spoils all).
TEST(FloorAndSlope, LeavesOutLevelsWithoutWeight) {
  std::vector<double> squares = squares_of({.floor = 0.3, .slope = 1.0}, kSixLevels);
  squares[5] = std::nan("");
  const FloorAndSlope found =
      fit_floor_and_slope(kSixLevels, squares, std::array{1.0, 1.0, 1.0, 1.0, 1.0, 0.0});
  EXPECT_NEAR(found.floor, 0.3, 1e-6);
  EXPECT_NEAR(found.slope, 1.0, 1e-6);
  EXPECT_TRUE(std::isnan(fit_floor_and_slope(kSixLevels, squares, std::vector<double>(6, 0.0)).floor));
}

// At the knee both have half of the square, also where the line is bent. Mutation: floor / slope.
TEST(UpperKnee, BendsTheLine) {
  const FloorAndSlope law = {.floor = 0.3, .slope = 1.0, .upper_knee = 0.5};
  EXPECT_NEAR(law.at(law.knee()), 0.3 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(law.at(0.5), std::sqrt(0.09 + 0.125), 1e-12);
  EXPECT_NEAR(law.at(1e6), std::sqrt(0.09 + 0.25), 1e-9);
  EXPECT_TRUE(std::isinf(FloorAndSlope({.floor = 0.3, .slope = 1.0, .upper_knee = 0.3}).knee()));
}

// Mutation: the first candidate that is better taken for the best.
TEST(UpperKnee, IsFoundToAStep) {
  const std::vector<double> levels = {0.0, 0.05, 0.2, 0.8, 3.2};
  for (const double upper_knee : {0.5, 1.1, 2.4}) {
    const FloorAndSlope law = {.floor = 3e-3, .slope = 1.0, .upper_knee = upper_knee};
    const FloorAndSlope found =
        fit_with_upper_knee(levels, squares_of(law, levels), std::vector<double>(5, 1.0));
    EXPECT_NEAR(slam::logarithm(found.upper_knee / upper_knee), 0.0, 0.1);
    EXPECT_NEAR(found.knee() / law.knee(), 1.0, 0.05);
  }
}

// A line is as good with no upper knee as with one far above. Mutation: a step taken that is no better.
TEST(UpperKnee, IsNoneOfALine) {
  const FloorAndSlope law = {.floor = 0.3, .slope = 1.0};
  EXPECT_TRUE(std::isinf(
      fit_with_upper_knee(kSixLevels, squares_of(law, kSixLevels), std::vector<double>(6, 1.0)).upper_knee));
}

}  // namespace
}  // namespace stereobench::harness
