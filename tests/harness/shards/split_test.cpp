#include "harness/shards/split.h"

#include <algorithm>
#include <numeric>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "slam/math/random.h"

namespace stereobench::harness {
namespace {

using testing::Each;
using testing::ElementsAre;

std::vector<double> loads_of(const std::vector<double>& costs, std::size_t shards) {
  std::vector<double> loads(shards, 0.0);
  const std::vector<std::size_t> shard_of = split_by_cost(costs, shards);
  for (std::size_t unit = 0; unit < costs.size(); ++unit) loads.at(shard_of[unit]) += costs[unit];
  return loads;
}

/// Costs that differ by a factor of a thousand.
std::vector<double> unlike_costs(std::uint64_t seed, std::size_t units) {
  slam::RandomStream random(seed, slam::Stream::kWorld);
  std::vector<double> costs;
  for (std::size_t i = 0; i < units; ++i) costs.push_back(std::exp(7.0 * random.uniform()));
  return costs;
}

// Law (Graham 1969): no shard has more than the mean and one unit that is not the costliest of all but of
// those that are dealt last; for any list, at most mean + (1 - 1/n) max. Mutation: units dealt round.
TEST(Split, IsEvenUpToAUnit) {
  for (std::uint64_t seed = 0; seed < 50; ++seed)
    for (const std::size_t shards : {1U, 2U, 7U, 40U}) {
      const std::vector<double> costs = unlike_costs(seed, 5 + 13 * seed % 200);
      const std::vector<double> loads = loads_of(costs, shards);
      const double sum = std::accumulate(costs.begin(), costs.end(), 0.0), n = static_cast<double>(shards);
      EXPECT_LE(std::ranges::max(loads), sum / n + (1.0 - 1.0 / n) * std::ranges::max(costs) + 1e-9 * sum);
      EXPECT_NEAR(std::accumulate(loads.begin(), loads.end(), 0.0), sum, 1e-9 * sum);
    }
}

// Against the best that can be, found by trying all ways. Mutations: the order of the units as it is; the
// cheapest first.
TEST(Split, IsAsGoodAsItsBoundSays) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const std::vector<double> costs = unlike_costs(seed, 9);
    double best = 1e9;
    for (int way = 0; way < 19683; ++way) {  // 3 to the 9
      std::vector<double> loads(3, 0.0);
      for (int unit = 0, rest = way; unit < 9; ++unit, rest /= 3)
        loads[static_cast<std::size_t>(rest % 3)] += costs[static_cast<std::size_t>(unit)];
      best = std::min(best, std::ranges::max(loads));
    }
    EXPECT_LE(std::ranges::max(loads_of(costs, 3)), (4.0 / 3.0 - 1.0 / 9.0) * best * (1.0 + 1e-12)) << seed;
  }
}

TEST(Split, OfEqualCostsIsByCount) {
  EXPECT_THAT(split_by_cost({1, 1, 1, 1, 1}, 2), ElementsAre(0, 1, 0, 1, 0));
  EXPECT_THAT(loads_of(std::vector<double>(100, 1.0), 40),
              Each(testing::AllOf(testing::Ge(2), testing::Le(3))));
  EXPECT_THAT(split_by_cost({0, 0, 0}, 2), Each(testing::Lt(2U)));
  EXPECT_TRUE(split_by_cost({}, 2).empty());
}

// Law: without overlap each unit is one shard's; with it, units of the next shard are two shards'.
TEST(UnitsOfShard, AreAllOfThemOnceAndOverlapTwice) {
  const std::vector<double> costs = unlike_costs(3, 50);
  for (const std::size_t shards : {1U, 3U, 60U})
    for (const std::size_t overlap : {0U, 1U, 4U}) {
      std::multiset<std::size_t> done;
      for (std::size_t number = 1; number <= shards; ++number) {
        const auto units = units_of_shard(costs, {number, shards}, overlap);
        EXPECT_TRUE(std::ranges::is_sorted(units));
        done.insert(units.begin(), units.end());
      }
      std::size_t twice = 0;
      for (std::size_t unit = 0; unit < costs.size(); ++unit) {
        EXPECT_GE(done.count(unit), 1U);
        EXPECT_LE(done.count(unit), 2U);
        twice += done.count(unit) == 2 ? 1U : 0U;
      }
      if (shards == 3) {
        EXPECT_EQ(twice, 3 * overlap);
      }
      if (shards == 1) {
        EXPECT_EQ(twice, 0U);
      }
    }
}

}  // namespace
}  // namespace stereobench::harness
