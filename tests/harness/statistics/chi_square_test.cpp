#include "harness/statistics/chi_square.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "slam/math/random.h"

namespace stereobench::harness {
namespace {

// Table 26.8 of Abramowitz and Stegun.
TEST(ChiSquare, QuantilesAreThoseOfTheTables) {
  EXPECT_NEAR(chi_square_quantile(0.95, 1), 3.84146, 5e-6);
  EXPECT_NEAR(chi_square_quantile(0.99, 2), 9.21034, 5e-6);
  EXPECT_NEAR(chi_square_quantile(0.95, 3), 7.81473, 5e-6);
  EXPECT_NEAR(chi_square_quantile(0.05, 30), 18.4927, 5e-5);
  EXPECT_NEAR(chi_square_quantile(0.975, 100), 129.561, 5e-4);
}

// Mutations: a band that leaves out 5 % at each end; of sums and not of ratios.
TEST(ChiSquare, BandLeavesOutTheSameAtBothEnds) {
  const Band band = chi_square_band(0.95, 100);
  EXPECT_NEAR(100.0 * band.low, 74.2219, 5e-4);
  EXPECT_NEAR(100.0 * band.high, 129.561, 5e-4);
  EXPECT_NEAR(chi_square_below({100.0 * band.high, 100}), 0.975, 1e-9);
  EXPECT_TRUE(std::isnan(chi_square_band(0.95, 0).low));
}

// Of two degrees of freedom the chance of more than x is exp(-x / 2). Mutation: a p-value of one side.
TEST(ChiSquare, PIsOfBothSides) {
  for (const double x : {3.0, 10.0, 100.0, 1000.0})
    EXPECT_NEAR(chi_square_p({x, 2}) / (2.0 * std::exp(-0.5 * x)), 1.0, 1e-9);
  EXPECT_NEAR(chi_square_p({0.01, 2}), 2.0 * (1.0 - std::exp(-0.005)), 1e-12);
  EXPECT_EQ(chi_square_p({1e6, 2}), 0.0);
  EXPECT_EQ(chi_square_p({std::numeric_limits<double>::infinity(), 2}), 0.0);
  EXPECT_EQ(chi_square_p({}), 1.0);
}

// p-values of consistent sums are uniform: the greatest distance of 5,000 sorted ones from that is below 1.95
// / 71 with a probability of 99.9 % (Kolmogorov).
TEST(ChiSquare, PIsUniformWhenAllIsConsistent) {
  slam::RandomStream random(5, slam::Stream::kWorld);
  std::vector<double> p_values;
  for (int i = 0; i < 5000; ++i) {
    SquaredSum sum;
    for (int k = 0; k < 7; ++k) {
      const double n = random.normal();
      sum += {n * n, 1};
    }
    p_values.push_back(chi_square_p(sum));
  }
  std::sort(p_values.begin(), p_values.end());
  double farthest = 0.0;
  for (std::size_t i = 0; i < p_values.size(); ++i)
    farthest = std::max(farthest, std::abs(p_values[i] - (static_cast<double>(i) + 0.5) / 5000.0));
  EXPECT_LT(farthest, 1.95 / std::sqrt(5000.0));
}

// The same log ten times tells no more than once. Mutation: ten times the degrees of freedom.
TEST(ChiSquare, SeedsThatHangTogetherAreWorthOne) {
  SquaredSum ten;
  for (int i = 0; i < 10; ++i) ten += {7.0, 3};
  const SquaredSum one = worth(ten, Seeds::kFilters, 10);
  EXPECT_DOUBLE_EQ(one.sum, 7.0);
  EXPECT_EQ(one.degrees_of_freedom, 3);
  EXPECT_EQ(worth(ten, Seeds::kWorlds, 10).degrees_of_freedom, 30);
  EXPECT_EQ(worth({}, Seeds::kFilters, 0).degrees_of_freedom, 0);
}

// By hand: 4 x 0.01, 3 x 0.02, 2 x 0.03 (0.06 already), 1 x 0.5. Mutations: Bonferroni; adjusted values
// that fall; values in sorted order.
TEST(Holm, IsWhatItIsByHand) {
  const std::vector<double> adjusted = holm(std::vector{0.03, 0.5, 0.01, 0.02});
  ASSERT_EQ(adjusted.size(), 4U);
  EXPECT_DOUBLE_EQ(adjusted[0], 0.06);
  EXPECT_DOUBLE_EQ(adjusted[1], 0.5);
  EXPECT_DOUBLE_EQ(adjusted[2], 0.04);
  EXPECT_DOUBLE_EQ(adjusted[3], 0.06);
  EXPECT_EQ(holm(std::vector{0.8, 0.9}), (std::vector{1.0, 1.0}));
  EXPECT_TRUE(holm({}).empty());
}

}  // namespace
}  // namespace stereobench::harness
