#include "harness/sensitivity/pick_freeze.h"

#include <algorithm>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace stereobench::harness {
namespace {

using testing::Each;

constexpr std::size_t kRows = 64;

Factors two_keys_and_two_streams() {
  return {.keys = {{"a", 0.0, 1.0}, {"b", -2.0, 2.0}}, .streams = {"world", "filter"}};
}

/// The value of a factor, whatever it is.
double value_of(const StudyPoint& point, std::size_t factor) {
  const std::size_t keys = point.values.size();
  return factor < keys ? point.values[factor] : static_cast<double>(point.seeds[factor - keys]);
}

// Mutations: the copies are of B with a column of A; the wrong column is taken.
TEST(PickFreezePoints, CopiesAreOfAWithOneColumnOfB) {
  const auto points = pick_freeze_points(two_keys_and_two_streams(), kRows, 3);
  ASSERT_EQ(points.size(), count_of_points(two_keys_and_two_streams(), kRows));
  ASSERT_EQ(points.size(), 6 * kRows);
  for (std::size_t copy = 0; copy < 4; ++copy)
    for (std::size_t j = 0; j < kRows; ++j)
      for (std::size_t factor = 0; factor < 4; ++factor) {
        const StudyPoint& from = points[factor == copy ? kRows + j : j];
        EXPECT_EQ(value_of(points[(2 + copy) * kRows + j], factor), value_of(from, factor));
      }
}

// Mutation: the seeds of a study do not depend on its own.
TEST(PickFreezePoints, EachRowHasASeedInAAndOneInB) {
  std::set<std::uint64_t> seeds;
  for (const std::uint64_t study : {0U, 1U, 2U}) {
    const auto points = pick_freeze_points(two_keys_and_two_streams(), kRows, study);
    for (std::size_t j = 0; j < 2 * kRows; ++j) {
      EXPECT_THAT(points[j].seeds, Each(2 * kRows * study + j));
      seeds.insert(points[j].seeds.front());
    }
  }
  EXPECT_EQ(seeds.size(), 6 * kRows);
}

// Of Sobol' points each column has as many in each sixteenth. Mutation: the first point, which is 0 before
// the shift, is left out.
TEST(PickFreezePoints, LieEvenlyInEachColumn) {
  const auto points = pick_freeze_points(two_keys_and_two_streams(), kRows, 5);
  for (const std::size_t table : {0U, 1U})
    for (const std::size_t key : {0U, 1U}) {
      std::vector<std::size_t> counts(16, 0);
      for (std::size_t j = 0; j < kRows; ++j) {
        const double value = points[table * kRows + j].values[key];
        ++counts.at(static_cast<std::size_t>(16.0 * (key == 0 ? value : 0.25 * (value + 2.0))));
      }
      EXPECT_THAT(counts, Each(kRows / 16)) << table << key;
    }
}

// Mutation: A and B have the same columns of the sequence.
TEST(PickFreezePoints, TablesHaveNothingInCommon) {
  const Factors factors{.keys = {{"a", -1.0, 1.0}}, .streams = {}};
  const auto points = pick_freeze_points(factors, 1024, 0);
  double product = 0.0;
  for (std::size_t j = 0; j < 1024; ++j) product += points[j].values[0] * points[1024 + j].values[0];
  EXPECT_NEAR(product / 1024.0, 0.0, 0.01);
}

// Mutation: no shift, which gives each seed the same points.
TEST(PickFreezePoints, DependOnTheSeedAndOnNothingElse) {
  const auto one = pick_freeze_points(two_keys_and_two_streams(), kRows, 1);
  const auto again = pick_freeze_points(two_keys_and_two_streams(), kRows, 1);
  const auto other = pick_freeze_points(two_keys_and_two_streams(), kRows, 2);
  for (std::size_t j = 0; j < kRows; ++j) {
    EXPECT_EQ(one[j].values, again[j].values);
    EXPECT_NE(one[j].values, other[j].values);
  }
}

TEST(PickFreezePoints, OfStreamsAloneAreSeeds) {
  const auto points = pick_freeze_points({.keys = {}, .streams = {"world"}}, kRows, 0);
  ASSERT_EQ(points.size(), 3 * kRows);
  EXPECT_EQ(points[2 * kRows].seeds.front(), kRows);
  EXPECT_TRUE(points.front().values.empty());
}

}  // namespace
}  // namespace stereobench::harness
