#include "harness/sweep/adaptive.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "slam/math/random.h"

namespace stereobench::harness {
namespace {

/// A sweep whose seeds differ by chance.
SweepResult sweep_of(const std::vector<double>& levels, const std::function<double(double)>& ate_of,
                     double noise = 1e-6) {
  SweepResult sweep{.name = "s", .variations = {{{"key"}, {}}}};
  for (const double level : levels) {
    sweep.variations.front().values.push_back(fmt::format("{}", level));
    SweepCell& cell = sweep.cells.emplace_back();
    cell.values = {sweep.variations.front().values.back()};
    slam::RandomStream random(5, slam::Stream::kWorld, sweep.cells.size());
    std::vector<double>& ate_m = cell.ate_m.emplace_back();
    for (int seed = 0; seed < 10; ++seed) ate_m.push_back(ate_of(level) * std::exp(noise * random.normal()));
  }
  return sweep;
}

/// An error of 1 up to 6, then as large as the level.
double knee_at_6(double level) {
  return std::max(1.0, level / 6.0);
}

/// The levels with as many more as are asked for.
std::vector<double> refined(std::vector<double> levels, const std::function<double(double)>& ate_of,
                            int count, double noise = 1e-6) {
  for (int i = 0; i < count; ++i) {
    const auto value = next_value(sweep_of(levels, ate_of, noise), false);
    EXPECT_TRUE(value);
    levels.insert(std::ranges::upper_bound(levels, std::stod(*value)), std::stod(*value));
  }
  return levels;
}

std::vector<double> spaced_by_ratio(double low, double high, int count) {
  std::vector<double> levels;
  for (int i = 0; i < count; ++i) levels.push_back(low * std::pow(high / low, i / (count - 1.0)));
  return levels;
}

/// How far the line between two levels is from the curve at most, in logarithms, at a thousand places.
double most_off(const std::vector<double>& levels, const std::function<double(double)>& ate_of) {
  double most = 0.0;
  for (const double level : spaced_by_ratio(levels.front(), levels.back(), 1000)) {
    const auto above = std::min(std::ranges::upper_bound(levels, level), levels.end() - 1);
    const double low = *(above - 1), high = *above;
    const double t = std::log(level / low) / std::log(high / low);
    const double line = (1.0 - t) * std::log(ate_of(low)) + t * std::log(ate_of(high));
    most = std::max(most, std::abs(line - std::log(ate_of(level))));
  }
  return most;
}

// Four levels and six added ones are at most half as far off as ten evenly spaced ones. Mutations: the pair
// that is nearest; second differences in place of divided ones; the curve's own heights in place of their
// logarithms.
TEST(NextValue, KnowsASharpBendSooner) {
  const std::vector<double> levels = refined(spaced_by_ratio(0.01, 100, 4), knee_at_6, 6);
  EXPECT_LT(most_off(levels, knee_at_6), 0.5 * most_off(spaced_by_ratio(0.01, 100, 10), knee_at_6));
}

// However often it is asked, it comes nearer to the knee.
TEST(NextValue, ComesNearToAKnee) {
  const std::vector<double> levels = refined({1, 10, 100}, knee_at_6, 10);
  double nearest = 10.0;
  for (const double level : levels) nearest = std::min(nearest, std::abs(level - 6.0));
  EXPECT_LT(nearest, 0.2);
}

// Chance alone makes no pair a place for all values. Mutation: the bend at one end alone.
TEST(NextValue, IsNotCaughtByChance) {
  const std::vector<double> levels = refined(
      spaced_by_ratio(0.01, 100, 4), [](double) { return 1.0; }, 9, 0.3);
  for (std::size_t i = 0; i + 1 < levels.size(); ++i) EXPECT_LT(levels[i + 1] / levels[i], 10.0) << levels[i];
}

// A step that no value can smooth, as filters that lose their way make, leaves values for a bend elsewhere.
// Mutation: the height of the bend in place of the area.
TEST(NextValue, IsNotCaughtByAStep) {
  const auto curve = [](double level) { return std::max(1.0, 0.1 / level) * (level < 6.3 ? 1.0 : 20.0); };
  const std::vector<double> levels = refined(spaced_by_ratio(0.01, 100, 4), curve, 12);
  double nearest = 100.0;
  for (const double level : levels) nearest = std::min(nearest, std::max(level / 0.1, 0.1 / level));
  EXPECT_LT(nearest, 1.3);
  const auto above = std::ranges::upper_bound(levels, 6.3);
  EXPECT_LT(*above / *(above - 1), 3.0);
}

// Mutation: distances are not compared.
TEST(NextValue, IsInTheWidestPairWhereNothingBends) {
  EXPECT_EQ(next_value(sweep_of(
                           {1, 2, 6, 7}, [](double) { return 1.0; }, 0.0),
                       false),
            "4");
}

// Over a decade it is halfway in ratio, and 0 stands apart. Mutations: the arithmetic mean; a decade between
// neighbours.
TEST(NextValue, IsHalfwayInRatioOverDecades) {
  EXPECT_EQ(next_value(sweep_of({1, 4, 16}, knee_at_6), false), "2");
  EXPECT_EQ(next_value(sweep_of({0, 1, 4, 16}, knee_at_6), false), "2");
  EXPECT_EQ(next_value(sweep_of({4, 8, 12}, knee_at_6), false), "6");
}

// Mutations: 4.5 for a key of whole numbers; an end of the pair.
TEST(NextValue, IsWholeWhereTheKeyIs) {
  EXPECT_EQ(next_value(sweep_of({3, 6, 7}, knee_at_6), true), "4");
  EXPECT_EQ(next_value(sweep_of({5, 6, 7}, knee_at_6), true), std::nullopt);
}

// A filter that fails, or makes no error at all, has no bend there. Mutations: areas without end count; what
// is no number is larger than any area.
TEST(NextValue, LeavesOutWhatIsNotKnown) {
  const auto fails_at_12 = [](double level) { return level == 12.0 ? std::nan("") : knee_at_6(level); };
  EXPECT_EQ(next_value(sweep_of({4, 6, 8, 12}, fails_at_12), false), "5");
  const auto none_at_12 = [](double level) { return level == 12.0 ? 0.0 : knee_at_6(level); };
  EXPECT_EQ(next_value(sweep_of({4, 6, 8, 12}, none_at_12), false), "5");
  EXPECT_EQ(next_value(sweep_of(
                           {4, 6, 12}, [](double) { return 0.0; }, 0.0),
                       false),
            "9");
}

TEST(NextValue, NeedsNumbers) {
  EXPECT_THROW(numbers_of({{"key"}, {"1", "two"}}), std::runtime_error);
  EXPECT_EQ(numbers_of({{"key"}, {"1", "2e-3"}}), (std::vector<double>{1.0, 2e-3}));
}

}  // namespace
}  // namespace stereobench::harness
