// Laws of Filter as a value and of the table of filters, over every row.
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "slam/filter_registry.h"
#include "tests/slam/example_filter.h"

namespace stereobench::slam {
namespace {

constexpr Control kAhead = {1.0, 0.0, 0.5};

struct NoCopies {
  NoCopies(const NoCopies&) = delete;
};
static_assert(!FilterType<NoCopies>);
static_assert(!FilterType<Pose>);

// Red when Filter's predict does not reach the filter it holds.
TEST(FilterValue, HoldsAFilterThatSlamHasNeverHeardOf) {
  Filter filter = ExampleFilter({}, {1.0, 2.0, 0.0});
  predict(filter, kAhead);
  predict(filter, kAhead);
  update(filter, {});
  EXPECT_EQ(estimate(filter).pose.x_m, 2.0);
  EXPECT_EQ(estimate_without_map(filter).pose.y_m, 2.0);
  EXPECT_EQ(particle_count(filter), 1);
  EXPECT_TRUE(last_decisions(filter).sightings.empty());
  EXPECT_TRUE(last_update(filter).innovations.empty());
}

// What the page shows keeps what is asked of every filter.
TEST(FilterValue, TheExampleCountsInputsThatAreNotFiniteAndIsUncertain) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Filter filter = ExampleFilter({.odometry_noise = {0.1, 0.0, 0.0, 0.1, 0.0, 0.0}}, {1.0, 2.0, 0.0});
  predict(filter, {nan, 0.0, 0.5});
  update(filter, std::vector<RangeBearing>{{.range_m = nan}});
  EXPECT_EQ(estimate(filter).counters.rejected_inputs, 2);
  EXPECT_EQ(estimate(filter).pose.x_m, 1.0);
  for (int i = 0; i < 2; ++i) predict(filter, {1.0, 3.0, 0.5});
  EXPECT_EQ(estimate(filter).pose.x_m, 2.0);
  EXPECT_GT(estimate(filter).covariance.diagonal().minCoeff(), 0.0);
}

class Registry : public ::testing::TestWithParam<std::string> {};

// Red when the copy constructor or the assignment shares what is held (a shared_ptr in place of clone).
TEST_P(Registry, ACopyGoesItsOwnWay) {
  const Filter original = make_filter(GetParam(), {}, {}, 1);
  Filter copy = original;
  predict(copy, kAhead);
  Filter assigned = make_filter("dead_reckoning", {}, {5.0, 5.0, 0.0}, 1);
  assigned = copy;
  EXPECT_EQ(estimate(assigned).pose.x_m, estimate(copy).pose.x_m);
  EXPECT_EQ(particle_count(assigned), particle_count(original));
  predict(copy, kAhead);
  EXPECT_NE(estimate(assigned).pose.x_m, estimate(copy).pose.x_m);
  EXPECT_EQ(estimate(original).pose.x_m, 0.0);
}

// Red when a row has no title, or find_filter_kind gives another row.
TEST_P(Registry, HasATitleAndIsFoundByItsName) {
  const FilterKind* const kind = find_filter_kind(GetParam());
  ASSERT_NE(kind, nullptr);
  EXPECT_EQ(kind->name, GetParam());
  EXPECT_FALSE(kind->title.empty());
}

INSTANTIATE_TEST_SUITE_P(Filters, Registry, ::testing::ValuesIn(filter_names()),
                         [](const auto& test) { return test.param; });

// Red when a row is there twice.
TEST(FilterRegistry, NamesAndTitlesAreThereOnce) {
  std::set<std::string_view> names, titles;
  for (const FilterKind& kind : filter_kinds()) {
    EXPECT_TRUE(names.insert(kind.name).second) << kind.name;
    EXPECT_TRUE(titles.insert(kind.title).second) << kind.title;
  }
}

// Red when the message leaves a name out, or an unknown name gives some filter.
TEST(FilterRegistry, AnUnknownNameIsToldAllThereAre) {
  EXPECT_EQ(find_filter_kind("kalman"), nullptr);
  try {
    make_filter("kalman", {}, {}, 0);
    FAIL() << "no error";
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(std::string(error.what()).find("make_filter: no filter 'kalman'; there are dead_reckoning, "),
              0U);
    for (const std::string& name : filter_names())
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace stereobench::slam
