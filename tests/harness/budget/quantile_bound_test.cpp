#include "harness/budget/quantile_bound.h"

#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

/// P(Binomial(n, p) = 0, 1, ... n), one trial after the other.
std::vector<double> binomial(long n, double p) {
  std::vector<double> chance = {1.0};
  for (long trial = 0; trial < n; ++trial) {
    chance.push_back(0.0);
    for (std::size_t k = chance.size() - 1; k > 0; --k) chance[k] = chance[k] * (1.0 - p) + chance[k - 1] * p;
    chance[0] *= 1.0 - p;
  }
  return chance;
}

/// P(Binomial >= k)
double upper_tail(const std::vector<double>& chance, long k) {
  double sum = 0.0;
  for (std::size_t i = chance.size(); i > static_cast<std::size_t>(k); --i) sum += chance[i - 1];
  return sum;
}

// Mutations: one more or one less may fail; the share in place of what is left of it; "above" for "at least".
TEST(QuantileBound, OrderIsTheLargestThatASumOfTheBinomialAllows) {
  for (const double share : {0.5, 0.8, 0.95, 0.99})
    for (const double confidence : {0.8, 0.95, 0.99})
      for (const long n : {1L, 5L, 20L, 58L, 59L, 100L, 300L, 500L}) {
        const long order = order_of_bound(n, {share, confidence});
        const std::vector<double> chance = binomial(n, 1.0 - share);
        ASSERT_LE(order, n);
        EXPECT_GE(upper_tail(chance, order), confidence) << n << " " << share << " " << confidence;
        EXPECT_LT(upper_tail(chance, order + 1), confidence) << n << " " << share << " " << confidence;
      }
}

// Wilks's numbers of runs for 95 % and 95 %, as tables of nuclear safety have them.
TEST(QuantileBound, OrdersAreThoseOfTheTables) {
  const std::vector<long> fewest = {59, 93, 124, 153, 181, 208, 234};
  for (std::size_t i = 0; i < fewest.size(); ++i) {
    EXPECT_EQ(order_of_bound(fewest[i], {}), static_cast<long>(i) + 1);
    EXPECT_EQ(order_of_bound(fewest[i] - 1, {}), static_cast<long>(i));
  }
}

// Mutation: rounded down.
TEST(QuantileBound, FewestWorldsAreJustEnough) {
  EXPECT_EQ(fewest_worlds({}), 59);
  EXPECT_EQ(fewest_worlds({0.5, 0.5}), 1);
  for (const double share : {0.5, 0.9, 0.99, 0.999})
    for (const double confidence : {0.5, 0.9, 0.95, 0.999}) {
      const long fewest = fewest_worlds({share, confidence});
      EXPECT_EQ(order_of_bound(fewest, {share, confidence}), 1) << share << " " << confidence;
      EXPECT_EQ(order_of_bound(fewest - 1, {share, confidence}), 0) << share << " " << confidence;
    }
}

TEST(QuantileBound, SaysHowManySeedsAreNeeded) {
  EXPECT_EQ(order_of_seeds(93, {}), 2);
  EXPECT_THAT(
      [] {
        order_of_seeds(20, {0.9, 0.95});
      },
      ThrowsMessage<std::runtime_error>("--seeds: a statement on at least 90 % of worlds, with 95 % "
                                        "confidence needs 29 seeds or more, got 20"));
}

TEST(QuantileBound, RefusesWhatIsNoShare) {
  for (const double bad : {0.0, 1.0, -0.1, 95.0}) {
    EXPECT_THROW(order_of_bound(100, {bad, 0.95}), std::invalid_argument);
    EXPECT_THROW(fewest_worlds({0.95, bad}), std::invalid_argument);
  }
}

}  // namespace
}  // namespace stereobench::harness
