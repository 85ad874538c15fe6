#include "harness/statistics/change_point.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include "slam/math/random.h"
#include "tests/harness/statistics/drawn_history.h"

namespace stereobench::harness {
namespace {

/// Levels that all seeds have, times 1, 2, ...
std::vector<Series> without_noise(const Series& levels, std::size_t seeds) {
  std::vector<Series> all;
  for (std::size_t seed = 1; seed <= seeds; ++seed) {
    Series& series = all.emplace_back();
    for (const double level : levels) series.push_back(level * static_cast<double>(seed));
  }
  return all;
}

std::vector<std::size_t> places_of(const std::vector<ChangePoint>& changes) {
  std::vector<std::size_t> places;
  for (const ChangePoint& change : changes) places.push_back(change.place);
  return places;
}

double rank_by_counting(const std::vector<double>& values, double value) {
  double rank = 0.5;
  for (const double other : values) rank += other < value ? 1.0 : other == value ? 0.5 : 0.0;
  return rank;
}

/// The largest statistic, by the letter of the header: no sum is kept from one place to the next.
double largest_statistic(const std::vector<Series>& seeds) {
  const std::size_t results = seeds.front().size();
  double largest = 0.0;
  for (std::size_t place = 1; place < results; ++place) {
    double signed_sum = 0.0, signed_squares = 0.0, cusum = 0.0, cusum_squares = 0.0;
    std::vector<double> sizes;
    for (const Series& series : seeds)
      if (series[place] != series[place - 1]) sizes.push_back(std::abs(series[place] - series[place - 1]));
    for (const Series& series : seeds) {
      const double difference = series[place] - series[place - 1];
      const double rank = difference == 0.0 ? 0.0 : rank_by_counting(sizes, std::abs(difference));
      signed_sum += difference > 0.0 ? rank : -rank;
      signed_squares += rank * rank;
      double x = 0.0, xx = 0.0, y = 0.0, yy = 0.0, xy = 0.0;  // for the correlation with a step
      for (std::size_t i = 0; i < results; ++i) {
        const double step = i < place ? 0.0 : 1.0;
        const double own = rank_by_counting(series, series[i]);
        x += step, xx += step * step, y += own, yy += own * own, xy += step * own;
      }
      const auto n = static_cast<double>(results);
      const double r = (n * xy - x * y) / std::sqrt((n * xx - x * x) * (n * yy - y * y));
      cusum += r;
      cusum_squares += r * r;
    }
    if (signed_squares > 0.0) largest = std::max(largest, std::abs(signed_sum) / std::sqrt(signed_squares));
    largest = std::max(largest, std::abs(cusum) / std::sqrt(cusum_squares));
  }
  return largest;
}

double p_by_all_flips(const std::vector<Series>& seeds) {
  const double seen = largest_statistic(seeds);
  std::size_t as_large = 0;
  const std::size_t all = std::size_t{1} << seeds.size();
  for (std::size_t flips = 0; flips < all; ++flips) {
    std::vector<Series> flipped = seeds;
    for (std::size_t seed = 0; seed < seeds.size(); ++seed)
      if ((flips >> seed & 1U) != 0)
        for (double& value : flipped[seed]) value = -value;
    if (largest_statistic(flipped) >= seen - 1e-9) ++as_large;
  }
  return static_cast<double>(as_large) / static_cast<double>(all);
}

/// To few levels, so that many values are equal.
void round_to_tenths(std::vector<Series>& seeds) {
  for (Series& series : seeds)
    for (double& value : series) value = 0.1 * std::round(10.0 * value);
}

// Every second one has values that repeat from result to result, others than those of the next seed.
// Mutations: a flip less; statistics that are not scaled; ranks of unchanged seeds counted; one of the two
// statistics left out; values in place of ranks; the statistic of one place for the largest.
TEST(ChangePoint, HasThePValueOfAllFlips) {
  for (std::uint64_t key = 0; key < 24; ++key) {
    DrawnHistory kind{.seeds = 4 + key % 4, .results = 2 + key % 4, .changes = 0.7, .step = 1.2, .at = 1};
    std::vector<Series> seeds = draw_history(kind, key);
    if (key % 2 == 1) round_to_tenths(seeds);
    const bool none_changed = std::ranges::all_of(seeds, [](const Series& series) {
      return std::ranges::count(series, series.front()) == std::ssize(series);
    });
    if (none_changed) continue;
    EXPECT_NEAR(find_change(seeds, 0.01).p, p_by_all_flips(seeds), 1e-12) << key;
  }
}

// Mutation: seeds that are equal in all results kept (17 of them are too many for all flips).
TEST(ChangePoint, LeavesOutSeedsThatDoNotChange) {
  const std::vector<Series> seeds = draw_history({.seeds = 14, .results = 5, .step = 1.2, .at = 3}, 0);
  std::vector<Series> more = seeds;
  more.insert(more.end(), 3, Series(5, 1.0));
  EXPECT_EQ(find_change(more, 0.01).p, find_change(seeds, 0.01).p);
}

// Of 20 coins five or fewer fall alike with a probability of 0.0414. A p-value rests on the 20 flips that are
// as clear, the mean of ten of them on many more. Mutation: bits that are drawn for the first flips alone,
// and counted on from there (0.073, as the last seeds never flip).
TEST(ChangePoint, HasNearlyThatPValueWhereFlipsAreDrawn) {
  double mean = 0.0;
  for (std::size_t key = 0; key < 10; ++key) {
    std::vector<Series> seeds(20, {1.0, 2.0});
    for (const std::size_t falling : {key, key + 5, std::size_t{17}, std::size_t{18}, std::size_t{19}})
      seeds[falling] = {2.0, 1.0};
    mean += 0.1 * find_change(seeds, 0.01).p;
  }
  EXPECT_NEAR(mean, 0.0414, 0.012);
}

// 99,999 flips and what is seen. Mutation: what is seen not counted (0).
TEST(ChangePoint, HasNoPValueOfZero) {
  EXPECT_EQ(find_change(without_noise({1, 1, 2}, 40), 0.01).p, 1e-5);
}

TEST(ChangePoint, IsNoneWhereAllIsEqual) {
  const std::vector<Series> seeds = without_noise({1.0, 1.0, 1.0, 1.0}, 20);
  EXPECT_EQ(find_change(seeds, 0.01).p, 1.0);
  EXPECT_TRUE(find_changes(seeds, 0.5).empty());
}

// A A A B B B without noise: as improbable as ten coins that fall alike, where the level changes and nowhere
// else. Mutations: the place of the smallest p (all places have the same here); parts that begin a result
// late.
TEST(ChangePoint, IsFoundBetweenLevelsWithoutNoise) {
  const std::vector<ChangePoint> found = find_changes(without_noise({1, 1, 1, 1.01, 1.01, 1.01}, 10), 0.01);
  ASSERT_EQ(places_of(found), std::vector<std::size_t>{3});
  EXPECT_EQ(found[0].p, std::ldexp(1.0, -9));
  EXPECT_EQ(places_of(find_changes(without_noise({1, 1, 1, 1, 1, 1, 1, 2}, 12), 0.01)),
            std::vector<std::size_t>{7});
  EXPECT_EQ(places_of(find_changes(without_noise({2, 1}, 12), 0.01)), std::vector<std::size_t>{1});
}

// Mutations: only what is behind the clearest step, or only what is before it; a part that begins a result
// late; p of a part as if it were the whole.
TEST(ChangePoint, IsFoundMoreThanOnce) {
  using Places = std::vector<std::size_t>;
  const auto places = [](const Series& levels) {
    return places_of(find_changes(without_noise(levels, 14), 0.01));
  };
  EXPECT_EQ(places({1, 1, 2, 2, 2, 1, 1}), (Places{2, 5}));
  EXPECT_EQ(places({1, 2, 2, 2, 3, 3, 3, 3}), (Places{1, 4}));
  EXPECT_EQ(places({1, 1, 1, 1, 1, 2, 3}), (Places{5, 6}));
  const std::vector<ChangePoint> found = find_changes(without_noise({1, 1, 1, 1, 1, 2, 3}, 14), 0.01);
  EXPECT_EQ(found[0].p, std::ldexp(1.0, -13));
  EXPECT_EQ(found[1].p, std::ldexp(1.0, -12));
}

// What half of the seeds gain is what the others lose, by the same sizes: a harmless change of the numbers.
// Mutation: the sizes of changes without their signs.
TEST(ChangePoint, IsNoneWhereSeedsDoNotAgree) {
  std::vector<Series> seeds;
  for (int seed = 0; seed < 20; ++seed) {
    const double other = 1.0 + (seed % 2 == 0 ? 0.1 : -0.1) * (1.0 + seed / 2);
    seeds.push_back({1, 1, 1, other, other, other});
  }
  EXPECT_GT(find_change(seeds, 0.01).p, 0.5);
}

// What a seed is worth, and the unit, do not matter; backwards the step is at the other end.
TEST(ChangePoint, DoesNotDependOnUnitSignOrWorld) {
  const std::vector<Series> seeds = draw_history({.seeds = 12, .noise = 0.1, .step = 1.2}, 1);
  const ChangePoint change = find_change(seeds, 0.01);
  EXPECT_EQ(change.place, 6U);
  std::vector<Series> moved = seeds, backwards = seeds;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    for (double& value : moved[i]) value = 64.0 * static_cast<double>(i) - 4.0 * value;
    std::ranges::reverse(backwards[i]);
  }
  EXPECT_EQ(find_change(moved, 0.01).p, change.p);
  EXPECT_EQ(find_change(moved, 0.01).place, change.place);
  EXPECT_EQ(find_change(backwards, 0.01).p, change.p);
  EXPECT_EQ(find_change(backwards, 0.01).place, seeds[0].size() - change.place);
}

// A filter that is lost now and then, fifty times as wrong, hides no step. Mutation: values in place of
// ranks.
TEST(ChangePoint, IsNotHiddenByLostSeeds) {
  int found = 0;
  for (std::uint64_t key = 0; key < 40; ++key) {
    std::vector<Series> seeds = draw_history({.seeds = 20, .noise = 0.1, .step = 1.2}, key);
    slam::RandomStream random(key, slam::Stream::kClutter);
    for (Series& series : seeds)
      for (double& value : series) value *= random.uniform() < 0.06 ? 50.0 : 1.0;
    const std::vector<ChangePoint> changes = find_changes(seeds, 0.01);
    found += changes.size() == 1 && changes[0].place == 6 ? 1 : 0;
  }
  EXPECT_GE(found, 36);
}

/// How many of some histories have a change at all, and how many at the right place.
struct Found {
  int any = 0;
  int right = 0;
};

Found count_found(const DrawnHistory& kind, int histories, double level) {
  Found found;
  for (int i = 0; i < histories; ++i) {
    const auto places =
        places_of(find_changes(draw_history(kind, 1000 + static_cast<std::uint64_t>(i)), level));
    found.any += places.empty() ? 0 : 1;
    found.right += std::ranges::count(places, kind.at) > 0 ? 1 : 0;
  }
  return found;
}

// 400 histories without a step, at a level of 5 %: 20 false alarms, and three standard deviations of 4.4.
// Mutation: no correction for the number of places.
TEST(ChangePoint, RaisesNoMoreFalseAlarmsThanItsLevel) {
  EXPECT_LE(count_found({}, 400, 0.05).any, 33);
  EXPECT_LE(count_found({.seeds = 10, .changes = 0.2}, 400, 0.05).any, 33);
  EXPECT_LE(count_found({.seeds = 20, .results = 2, .noise = 0.8}, 400, 0.05).any, 33);
  EXPECT_LE(count_found({.seeds = 8, .results = 30, .noise = 0.8}, 200, 0.05).any, 19);
}

// The same where there is one step, beyond all doubt. Mutation: parts with the level of the whole.
TEST(ChangePoint, RaisesNoMoreFalseAlarmsBesideAStep) {
  const DrawnHistory kind{.seeds = 14, .results = 12, .step = 30.0};
  int further = 0;
  for (std::uint64_t key = 0; key < 400; ++key) {
    const auto places = places_of(find_changes(draw_history(kind, key), 0.05));
    EXPECT_EQ(std::ranges::count(places, kind.at), 1) << key;
    further += places.size() > 1 ? 1 : 0;
  }
  EXPECT_LE(further, 33);
}

// A regression of 20 % in the last of 12 results, of which one in five changed the numbers by 30 %, and one
// in the middle of 12 that all did. Mutations: no difference of neighbours (the first falls to a few); no
// CUSUM (the second does).
TEST(ChangePoint, FindsAStepAmongChangesOfTheNumbers) {
  EXPECT_GE(count_found({.seeds = 20, .changes = 0.2, .step = 1.2, .at = 11}, 60, 0.01).right, 42);
  EXPECT_GE(count_found({.seeds = 20, .noise = 0.2, .step = 1.2}, 60, 0.01).right, 42);
}

TEST(ChangePoint, NeedsSomeSeeds) {
  EXPECT_EQ(fewest_seeds_for(0.01), 8);  // 2^-7 is below 1 %
  EXPECT_EQ(fewest_seeds_for(0.01 / 30.0), 13);
  EXPECT_TRUE(find_changes(without_noise({1, 1, 2, 2}, 7), 0.01).empty());
  EXPECT_FALSE(find_changes(without_noise({1, 1, 2, 2}, 8), 0.01).empty());
}

TEST(ChangePoint, RefusesSeriesOfDifferentLengths) {
  EXPECT_THROW(find_change(std::vector<Series>{{1, 2}, {1, 2, 3}}, 0.01), std::invalid_argument);
  EXPECT_THROW(find_change(std::vector<Series>{{1}}, 0.01), std::invalid_argument);
}

}  // namespace
}  // namespace stereobench::harness
