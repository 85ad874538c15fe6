// Lists of seeds as people write them.
#include "harness/experiment/seeds.h"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace stereobench::harness {
namespace {

using testing::ElementsAre;

TEST(Seeds, AreReadAsPeopleWriteThem) {
  EXPECT_THAT(parse_seeds("0..3"), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(parse_seeds("7"), ElementsAre(7));
  EXPECT_THAT(parse_seeds("4,0,18446744073709551615"), ElementsAre(4, 0, 18446744073709551615ULL));
  EXPECT_THAT(parse_seeds("18446744073709551615..18446744073709551615"),
              ElementsAre(18446744073709551615ULL));
}

TEST(Seeds, ThatAreNoneAreRefused) {
  for (const char* text : {"", ",", "1,", "..", "1..", "..2", "3..1", "a", "-1", "1.5", "1,1", "0..10000",
                           " 1", "18446744073709551616", "0..1..2"}) {
    EXPECT_THROW(parse_seeds(text), std::invalid_argument) << text;
  }
}

}  // namespace
}  // namespace stereobench::harness
