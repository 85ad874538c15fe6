/// Shares of an error: laws that make them Shapley's, and a reference that walks all orders.
#include "harness/attribution/shapley.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <gtest/gtest.h>

#include "slam/math/random.h"

namespace stereobench::harness {
namespace {

using Errors = std::vector<std::vector<double>>;

Errors random_errors(std::size_t parts, std::size_t seeds) {
  slam::RandomStream random(7, slam::Stream::kWorld, parts);
  Errors errors(std::size_t{1} << parts, std::vector<double>(seeds));
  for (std::vector<double>& of_coalition : errors)
    for (double& error : of_coalition) error = random.normal();
  return errors;
}

/// The mean over all orders, one order after the other.
double share_by_orders(const Errors& errors, std::size_t part, std::size_t seed, std::size_t parts) {
  std::vector<std::size_t> order(parts);
  std::iota(order.begin(), order.end(), 0U);
  double sum = 0.0;
  double orders = 0.0;
  do {
    Coalition before = 0;
    for (const std::size_t next : order) {
      if (next == part) break;
      before |= Coalition{1} << next;
    }
    sum += errors[before][seed] - errors[before | (Coalition{1} << part)][seed];
    ++orders;
  } while (std::ranges::next_permutation(order).found);
  return sum / orders;
}

// Mutations: weights of 1 / 2^(n-1) (Banzhaf's); n - |S| in place of n - |S| - 1.
TEST(Shapley, IsTheMeanOverAllOrders) {
  for (const std::size_t parts : {1U, 2U, 3U, 5U}) {
    const Errors errors = random_errors(parts, 2);
    const auto worths = attribute(errors);
    ASSERT_EQ(worths.size(), parts);
    for (std::size_t part = 0; part < parts; ++part)
      for (std::size_t seed = 0; seed < 2; ++seed)
        EXPECT_NEAR(worths[part].share[seed], share_by_orders(errors, part, seed, parts), 1e-14);
  }
}

TEST(Shapley, AddsUpToTheWhole) {
  const Errors errors = random_errors(6, 10);
  const auto worths = attribute(errors);
  for (std::size_t seed = 0; seed < 10; ++seed) {
    double sum = 0.0;
    for (const PartWorth& worth : worths) sum += worth.share[seed];
    EXPECT_NEAR(sum, errors.front()[seed] - errors.back()[seed], 1e-14);
  }
}

// Mutations: the coalitions of `only_real` and `only_perfect` swapped; signs.
TEST(Shapley, OfPartsThatDoNotMeetIsWhatEachAdds) {
  const std::vector<double> adds = {0.5, 2.0, -1.0};
  Errors errors(8, std::vector<double>(1, 10.0));
  for (Coalition perfect = 0; perfect < errors.size(); ++perfect)
    for (std::size_t part = 0; part < adds.size(); ++part)
      if ((perfect >> part & 1U) == 0) errors[perfect][0] += adds[part];
  const auto worths = attribute(errors);
  for (std::size_t part = 0; part < adds.size(); ++part) {
    EXPECT_NEAR(worths[part].share[0], adds[part], 1e-14);
    EXPECT_NEAR(worths[part].only_perfect[0], adds[part], 1e-14);
    EXPECT_NEAR(worths[part].only_real[0], adds[part], 1e-14);
  }
}

// Two noises whose squares add: half each by symmetry, less where one alone becomes perfect, and more where
// one alone is left.
TEST(Shapley, OfTwoEqualNoisesIsHalfEach) {
  const double both = std::sqrt(2.0);
  const auto worths = attribute(Errors{{both}, {1.0}, {1.0}, {0.0}});
  for (const PartWorth& worth : worths) {
    EXPECT_NEAR(worth.share[0], both / 2.0, 1e-14);
    EXPECT_NEAR(worth.only_perfect[0], both - 1.0, 1e-14);
    EXPECT_NEAR(worth.only_real[0], 1.0, 1e-14);
  }
}

TEST(Shapley, OfASeedThatFailedAnywhereIsNotKnown) {
  Errors errors = random_errors(2, 2);
  errors[2][1] = std::numeric_limits<double>::quiet_NaN();
  for (const PartWorth& worth : attribute(errors)) {
    EXPECT_TRUE(std::isfinite(worth.share[0]));
    EXPECT_TRUE(std::isnan(worth.share[1]));
  }
}

TEST(Shapley, RefusesWhatIsNoSetOfCoalitions) {
  EXPECT_THROW(attribute(Errors{{1.0}}), std::invalid_argument);
  EXPECT_THROW(attribute(Errors{{1.0}, {1.0}, {1.0}}), std::invalid_argument);
  EXPECT_THROW(attribute(Errors{{1.0}, {1.0, 2.0}}), std::invalid_argument);
}

}  // namespace
}  // namespace stereobench::harness
