#include "tests/harness/statistics/drawn_history.h"

#include "slam/math/elementary.h"
#include "slam/math/random.h"

namespace stereobench::harness {

std::vector<Series> draw_history(const DrawnHistory& kind, std::uint64_t key) {
  slam::RandomStream random(key, slam::Stream::kOracle, kind.results);
  std::vector<bool> is_new(kind.results);
  for (std::size_t i = 0; i < kind.results; ++i) is_new[i] = i == 0 || random.uniform() < kind.changes;
  std::vector<Series> seeds;
  for (std::size_t seed = 0; seed < kind.seeds; ++seed) {
    const double world = slam::exponential(0.4 * random.normal());
    double value = 0.0;
    Series& series = seeds.emplace_back();
    for (std::size_t i = 0; i < kind.results; ++i) {
      if (is_new[i]) value = world * slam::exponential(kind.noise * random.normal());
      series.push_back(i < kind.at ? value : kind.step * value);
    }
  }
  return seeds;
}

}  // namespace stereobench::harness
