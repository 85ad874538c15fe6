#include "harness/budget/budget_range.h"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace stereobench::harness {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::vector<BudgetRange> some_ranges() {
  return {{"a", 0.0, 1.0},      {"a", 0.0, 3.7},   {"a", 0.25, 8.0}, {"a", 1.0, 1.1},  {"a", 1.0, 0.0},
          {"a", 1000.0, 10.0},  {"a", -1.0, 1.0},  {"a", 0.0, -5.0}, {"a", 0.0, 1e-7}, {"a", 2.0, 3e9},
          {"a", 600.0, 600.01}, {"a", -2.0, -0.3}, {"a", 0.0, 0.02}};
}

// Mutation: levels that stop short of the bad end, or overshoot it.
TEST(BudgetLevels, LeadFromTheGoodToTheBadEnd) {
  for (const BudgetRange& range : some_ranges()) {
    const std::vector<double> levels = budget_levels({range}, 0.02);
    EXPECT_EQ(levels.front(), range.low);
    EXPECT_EQ(levels.back(), range.high);
    for (std::size_t i = 1; i < levels.size(); ++i)
      EXPECT_GT((levels[i] - levels[i - 1]) * (range.high - range.low), 0.0) << range.low << " " << levels[i];
    EXPECT_LT(levels.size(), 1500U) << range.low << " " << range.high;
  }
}

// Mutations: the distance from zero alone; from the good end alone; steps that are rounded upwards.
TEST(BudgetLevels, AreAsNearToEachOtherAsTheToleranceAsks) {
  for (const double tolerance : {0.005, 0.02, 0.1})
    for (const BudgetRange& range : some_ranges()) {
      const std::vector<double> levels = budget_levels({range}, tolerance);
      for (std::size_t i = 1; i < levels.size(); ++i) {
        const double nearest = std::min(std::abs(levels[i - 1] - range.low), std::abs(levels[i - 1]));
        const double widest = std::max(tolerance * nearest, 1e-4 * std::abs(range.high - range.low));
        EXPECT_LE(std::abs(levels[i] - levels[i - 1]), 1.011 * widest) << range.low << " " << levels[i];
      }
    }
}

// What is printed with a few digits is the level to the last bit. Mutation: multiples of a step that is no
// decimal fraction, 3 * 0.1 for 0.3.
TEST(BudgetLevels, AreRoundNumbers) {
  for (const double level : budget_levels({{"a", 0.0, 1.0}}, 0.02))
    EXPECT_LE(fmt::format("{}", level).size(), 6U) << level;
  EXPECT_THAT(budget_levels({{"a", 0.0, 1.0}}, 0.5), testing::IsSupersetOf({0.0006, 0.06, 0.15, 0.3, 0.6}));
}

// Mutations: half a frame; steps of three.
TEST(BudgetLevels, OfWholeNumbersAreWhole) {
  EXPECT_THAT(budget_levels({{"a", 0.0, 6.0, true}}, 0.02), ElementsAre(0, 1, 2, 3, 4, 5, 6));
  EXPECT_THAT(budget_levels({{"a", 3.0, 1.0, true}}, 0.02), ElementsAre(3, 2, 1));
  EXPECT_THAT(budget_levels({{"a", 0.0, 40.0, true}}, 0.1),
              ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 22, 24,
                          26, 28, 30, 32, 34, 36, 38, 40));
  for (const double level : budget_levels({{"a", 5000.0, 10.0, true}}, 0.02))
    EXPECT_EQ(level, std::round(level));
  EXPECT_THAT(
      [] {
        budget_levels({{"a", 0.5, 6.0, true}}, 0.02);
      },
      ThrowsMessage<std::runtime_error>("--vary: a: expected whole numbers at both ends, got 0.5..6"));
}

// Mutations: values beyond the fraction; whole numbers rounded to the nearest, or towards zero.
TEST(BudgetMix, MovesAllLinesByTheSameFraction) {
  const BudgetMix mix = {{"a", 0.0, 2.0}, {"b", 1.0, 1.3}, {"c", 100.0, 10.0, true}, {"d", -3.0, 4.0, true}};
  EXPECT_EQ(budget_levels(mix, 0.02), budget_levels({{"x", 0.0, 1.0}}, 0.02));
  EXPECT_THAT(overrides_at(mix, 0.0), ElementsAre("a=0", "b=1", "c=100", "d=-3"));
  EXPECT_THAT(overrides_at(mix, 0.45), ElementsAre("a=0.9", "b=1.135", "c=60", "d=0"));
  EXPECT_THAT(overrides_at(mix, 0.13), ElementsAre("a=0.26", "b=1.039", "c=89", "d=-3"));
  EXPECT_THAT(overrides_at(mix, 1.0), ElementsAre("a=2", "b=1.3", "c=10", "d=4"));
  EXPECT_THAT(overrides_at({{"a", 0.0, 2.0}}, 0.45), ElementsAre("a=0.45"));
  EXPECT_EQ(name_of(mix), "a, b, c and d");
}

TEST(ParseBudgetRange, ReadsBothEnds) {
  const BudgetRange range = parse_budget_range("world.balls[0].at_m[0]=-1e-1..2.5");
  EXPECT_EQ(range.key, "world.balls[0].at_m[0]");
  EXPECT_EQ(range.low, -0.1);
  EXPECT_EQ(range.high, 2.5);
  EXPECT_EQ(parse_budget_range("a=1...5").high, 0.5);
  EXPECT_EQ(parse_budget_range("a=1..0").high, 0.0);
}

// Mutations: ends that are equal; text behind a number.
TEST(ParseBudgetRange, RefusesWhatIsNone) {
  for (const char* text : {"", "a", "a=", "=0..1", "a=0", "a=0..", "a=..1", "a=0..1x", "a=0..nan", "a=0..inf",
                           "a=1..1", "a=1..1.0000000001", "a=0,1", "a=0..1..2", "0..1"})
    EXPECT_THAT([&] { parse_budget_range(text); },
                ThrowsMessage<std::runtime_error>(
                    testing::AllOf(testing::StartsWith("--vary: "), HasSubstr("expected"))))
        << text;
}

TEST(BudgetLevels, RefuseAToleranceThatIsNone) {
  EXPECT_THROW(budget_levels({}, 0.02), std::invalid_argument);
  for (const double bad : {0.0, 0.0009, 0.51, std::nan("")})
    EXPECT_THROW(budget_levels({{"a", 0.0, 1.0}}, bad), std::invalid_argument);
}

}  // namespace
}  // namespace stereobench::harness
