#include "harness/sweep/sweep_response.h"

#include <gtest/gtest.h>

namespace stereobench::harness {
namespace {

SweepResult sweep_over(const std::vector<std::string>& values) {
  SweepResult sweep{.name = "s", .variations = {{{"key"}, values}}};
  for (std::size_t i = 0; i < values.size(); ++i) {
    SweepCell& cell = sweep.cells.emplace_back();
    cell.values = {values[i]};
    cell.result.filters = {{.filter = "ekf"}, {.filter = "iekf"}};
    const auto level = static_cast<double>(i);
    cell.ate_m = {{level, level + 0.1}, {2.0 * level, 2.0 * level + 0.1}};
    cell.bound_m = {0.5 * level, 0.5 * level};
  }
  return sweep;
}

// Mutations: filters swapped; levels by seed.
TEST(SweepResponse, HasTheErrorsOfEachFilterAndTheBound) {
  const auto response = response_of(sweep_over({"0", "0.5", "2"}));
  ASSERT_TRUE(response);
  EXPECT_EQ(response->parameter, "key");
  EXPECT_EQ(response->levels, (std::vector<double>{0.0, 0.5, 2.0}));
  ASSERT_EQ(response->filters.size(), 2U);
  EXPECT_EQ(response->filters[1].name, "iekf");
  EXPECT_EQ(response->filters[1].values[2], (std::vector<double>{4.0, 4.1}));
  EXPECT_EQ(response->bound.values[2], (std::vector<double>{1.0, 1.0}));
}

// Mutation: the origin left out.
TEST(SweepResponse, CountsFromTheReference) {
  SweepResult sweep = sweep_over({"0.12", "0.125", "0.13"});
  sweep.paired_to = "0.12";
  const auto response = response_of(sweep);
  ASSERT_TRUE(response);
  EXPECT_EQ(response->parameter, "key - 0.12");
  EXPECT_EQ(response->levels.front(), 0.0);
  EXPECT_EQ(response->levels.back(), 0.01);
}

// Mutations: each condition.
TEST(SweepResponse, IsNoneOfOtherSweeps) {
  EXPECT_FALSE(response_of(sweep_over({"0", "1"})));
  EXPECT_FALSE(response_of(sweep_over({"0", "two", "3"})));
  EXPECT_FALSE(response_of(sweep_over({"-1", "0", "1"})));
  EXPECT_FALSE(response_of(sweep_over({"0", "2", "1"})));
  EXPECT_FALSE(response_of(sweep_over({"0.12", "0.125", "0.13"})));
  EXPECT_TRUE(response_of(sweep_over({"1", "1.5", "2"})));
  SweepResult counts = sweep_over({"0", "1", "2"});
  counts.variations.front().keys = {"detector_noise.latency_frames"};
  EXPECT_FALSE(response_of(counts));
  SweepResult several = sweep_over({"0", "1", "2"});
  several.variations.push_back({{"other"}, {"1"}});
  EXPECT_FALSE(response_of(several));
  SweepResult without_bound = sweep_over({"0", "1", "2"});
  without_bound.cells[1].bound_m.clear();
  EXPECT_TRUE(response_of(without_bound)->bound.values.empty());
}

}  // namespace
}  // namespace stereobench::harness
