#include "harness/sweep/adaptive.h"

#include <cmath>
#include <functional>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "slam/math/random.h"

namespace stereobench::harness {
namespace {

/// A sweep whose seeds differ by their own amounts at all levels, and by chance.
SweepResult sweep_of(const std::vector<double>& levels, const std::function<double(double)>& ate_of,
                     double noise = 1e-6) {
  SweepResult sweep{.name = "s", .variations = {{{"key"}, {}}}};
  for (const double level : levels) {
    sweep.variations.front().values.push_back(fmt::format("{}", level));
    SweepCell& cell = sweep.cells.emplace_back();
    cell.values = {sweep.variations.front().values.back()};
    slam::RandomStream random(5, slam::Stream::kWorld, sweep.cells.size());
    std::vector<double>& ate_m = cell.ate_m.emplace_back();
    for (int seed = 0; seed < 10; ++seed)
      ate_m.push_back(ate_of(level) + 3.0 * seed + noise * random.normal());
  }
  return sweep;
}

double knee_at_6(double level) {
  return level < 6.0 ? 1.0 : 1.0 + (level - 6.0);
}

// Mutations: the narrower side; the smallest bend; the middle of the whole range.
TEST(NextValue, IsBesideTheSharpestBend) {
  EXPECT_EQ(next_value(sweep_of({0, 2, 4, 6, 10}, knee_at_6), false), "8");
  EXPECT_EQ(next_value(sweep_of({0, 3, 6, 7, 10}, knee_at_6), false), "4.5");
}

// However often it is asked, it comes nearer to the knee. Mutation: bends by height alone, with no width.
TEST(NextValue, ComesNearToAKnee) {
  std::vector<double> levels = {0, 5, 10};
  for (int i = 0; i < 8; ++i) {
    const auto value = next_value(sweep_of(levels, knee_at_6), false);
    ASSERT_TRUE(value);
    levels.push_back(std::stod(*value));
    std::sort(levels.begin(), levels.end());
  }
  double nearest = 10.0;
  for (const double level : levels) nearest = std::min(nearest, std::abs(level - 6.0));
  EXPECT_LT(nearest, 0.2);
}

// Mutations: intervals that are not looked at.
TEST(NextValue, IsNoneWhereNothingBends) {
  EXPECT_EQ(next_value(sweep_of({0, 1, 5, 6}, [](double x) { return 2.0 + x; }), false), std::nullopt);
  EXPECT_EQ(next_value(sweep_of({0, 3, 6, 7, 10}, knee_at_6, 5.0), false), std::nullopt);
  EXPECT_EQ(next_value(sweep_of({0, 3, 6}, [](double) { return 1.0; }), false), std::nullopt);
}

// Over decades it is halfway in ratio. Mutation: the arithmetic mean.
TEST(NextValue, IsHalfwayInRatioOverDecades) {
  EXPECT_EQ(next_value(sweep_of({1, 100, 101}, [](double x) { return x < 100.5 ? 1.0 : 2.0; }), false), "10");
}

// Mutation: 4.5 for a key of whole numbers.
TEST(NextValue, IsWholeWhereTheKeyIs) {
  EXPECT_EQ(next_value(sweep_of({0, 3, 6, 7, 10}, knee_at_6), true), "4");
  EXPECT_EQ(next_value(sweep_of({5, 6, 7}, knee_at_6), true), std::nullopt);
}

TEST(NextValue, NeedsNumbers) {
  EXPECT_THROW(numbers_of({{"key"}, {"1", "two"}}), std::runtime_error);
  EXPECT_EQ(numbers_of({{"key"}, {"1", "2e-3"}}), (std::vector<double>{1.0, 2e-3}));
}

}  // namespace
}  // namespace stereobench::harness
