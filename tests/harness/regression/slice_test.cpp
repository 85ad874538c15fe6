#include "harness/regression/slice.h"

#include <stdexcept>

#include <gmock/gmock.h>

#include "slam/math/random.h"

namespace stereobench::harness {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

/// Things at random: a range, a place, a colour of eighteen.
std::vector<Property> things(std::size_t count, slam::RandomStream& random) {
  std::vector<Property> properties = {{"range", "m", {}}, {"x", "px", {}}, {"colour", "", {}, true}};
  for (std::size_t i = 0; i < count; ++i) {
    properties[0].values.push_back(1.0 + 9.0 * random.uniform());
    properties[1].values.push_back(1024.0 * random.uniform());
    properties[2].values.push_back(static_cast<double>(random.bits() % 18));
  }
  return properties;
}

// 19 in 20 of the things of colour 3 from 4 to 6 m are marked.
// Mutation: a condition that holds too few of the marked things.
TEST(Slice, NamesWhatMarkedThingsHaveInCommon) {
  slam::RandomStream random(1, slam::Stream::kOracle);
  const std::vector<Property> properties = things(4000, random);
  std::vector<bool> marked;
  for (std::size_t i = 0; i < 4000; ++i) {
    const double range_m = properties[0].values[i];
    const bool planted = range_m >= 4.0 && range_m <= 6.0 && properties[2].values[i] == 3.0;
    marked.push_back(planted && random.uniform() < 0.95);
  }
  const Slice slice = find_slice(properties, marked);
  EXPECT_THAT(slice.conditions, ElementsAre("colour 3", StartsWith("range ")));
  EXPECT_GE(slice.marked * 10, slice.all_marked * 9);
  EXPECT_LT(slice.things, 70U);
}

// Two colours far apart are no interval.
// Mutation: categories as intervals; sets of one category alone.
TEST(Slice, NamesCategoriesThatAreNoNeighbours) {
  slam::RandomStream random(3, slam::Stream::kOracle);
  const std::vector<Property> properties = things(2000, random);
  std::vector<bool> marked;
  for (const double colour : properties[2].values)
    marked.push_back((colour == 2.0 || colour == 13.0) && random.uniform() < 0.3);
  const Slice slice = find_slice(properties, marked);
  EXPECT_THAT(slice.conditions, ElementsAre("colour 2 or 13"));
  EXPECT_THAT(slice.rivals, IsEmpty());
}

// All things at the left are of colour 3, and no others are: nobody can tell which of both it is. The ball's
// number is another name of its colour, and no news.
// Mutations: no rivals; rivals that are another name.
TEST(Slice, NamesWhatCannotBeToldApart) {
  slam::RandomStream random(5, slam::Stream::kOracle);
  std::vector<Property> properties = {{"x", "px", {}}, {"colour", "", {}, true}, {"ball", "", {}, true}};
  std::vector<bool> marked;
  for (int i = 0; i < 800; ++i) {
    const bool is_left = i % 8 == 0;
    properties[0].values.push_back(is_left ? 100.0 * random.uniform() : 100.0 + 900.0 * random.uniform());
    properties[1].values.push_back(is_left ? 3.0 : 4.0 + i % 8);
    properties[2].values.push_back(properties[1].values.back() + 20.0);
    marked.push_back(is_left && i % 16 == 0);
  }
  const Slice slice = find_slice(properties, marked);
  ASSERT_EQ(slice.conditions.size(), 1U);
  ASSERT_EQ(slice.rivals.size(), 1U);
  EXPECT_THAT(slice.conditions[0] + slice.rivals[0], AllOf(HasSubstr("colour 3"), HasSubstr("x ")));
}

// All beyond 3.5 m is lost. Nine tenths of it have one of four colours that nothing nearer has: they are a
// smaller part, but not the cause.
// Mutation: the smallest part that holds enough.
TEST(Slice, NamesTheCauseRatherThanASmallerPart) {
  slam::RandomStream random(4, slam::Stream::kOracle);
  std::vector<Property> properties = {{"colour", "", {}, true}, {"range", "m", {}}};
  std::vector<bool> marked;
  for (int i = 0; i < 1600; ++i) {
    const double range_m = 1.0 + static_cast<double>(i % 400) / 100.0;
    marked.push_back(range_m >= 3.5);
    const bool has_far_colour = marked.back() && random.uniform() < 0.94;
    properties[0].values.push_back(has_far_colour ? i % 4 : 4 + i % 7);
    properties[1].values.push_back(range_m);
  }
  const Slice slice = find_slice(properties, marked);
  EXPECT_THAT(slice.conditions, ElementsAre("range 3.5 to 4.99 m"));
  EXPECT_EQ(slice.marked, slice.all_marked);
  EXPECT_THAT(slice.rivals, IsEmpty());
}

// Mutation: no test of chance, and a third of these sets of marks get a name.
TEST(Slice, NamesNothingWhereMarksAreThereByChance) {
  int named = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    slam::RandomStream random(seed, slam::Stream::kOracle);
    const std::vector<Property> properties = things(500, random);
    std::vector<bool> marked;
    for (std::size_t i = 0; i < 500; ++i) marked.push_back(random.uniform() < 0.008);
    named += find_slice(properties, marked).conditions.empty() ? 0 : 1;
  }
  EXPECT_LE(named, 3);
}

TEST(Slice, IsAllWhereAllOrNoneIsMarked) {
  slam::RandomStream random(2, slam::Stream::kOracle);
  const std::vector<Property> properties = things(100, random);
  for (const bool all : {true, false}) {
    const Slice slice = find_slice(properties, std::vector<bool>(100, all));
    EXPECT_THAT(slice.conditions, IsEmpty());
    EXPECT_EQ(slice.things, 100U);
    EXPECT_EQ(slice.marked, all ? 100U : 0U);
  }
  EXPECT_THAT(find_slice({}, {}).conditions, IsEmpty());
  EXPECT_THROW(find_slice(properties, std::vector<bool>(7, true)), std::invalid_argument);
}

}  // namespace
}  // namespace stereobench::harness
