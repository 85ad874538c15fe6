#include "harness/shards/split.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <queue>
#include <utility>

namespace stereobench::harness {

std::vector<std::size_t> split_by_cost(const std::vector<double>& costs, std::size_t shards) {
  std::vector<std::size_t> order(costs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t unit) { return costs[unit]; });
  using Load = std::pair<double, std::size_t>;  // of a shard
  std::priority_queue<Load, std::vector<Load>, std::greater<>> loads;
  for (std::size_t shard = 0; shard < shards; ++shard) loads.emplace(0.0, shard);
  std::vector<std::size_t> shard_of(costs.size());
  for (const std::size_t unit : order) {
    const auto [load, shard] = loads.top();
    loads.pop();
    shard_of[unit] = shard;
    loads.emplace(load + costs[unit], shard);
  }
  return shard_of;
}

std::vector<std::size_t> units_of_shard(const std::vector<double>& costs, const Shard& shard,
                                        std::size_t overlap) {
  const std::vector<std::size_t> shard_of = split_by_cost(costs, shard.count);
  const std::size_t own = shard.number - 1, next = shard.number % shard.count;
  std::vector<std::size_t> units;
  for (std::size_t unit = 0; unit < costs.size(); ++unit) {
    const bool is_extra = shard_of[unit] != own && shard_of[unit] == next && overlap > 0;
    if (shard_of[unit] == own || is_extra) units.push_back(unit);
    if (is_extra) --overlap;
  }
  return units;
}

}  // namespace stereobench::harness
