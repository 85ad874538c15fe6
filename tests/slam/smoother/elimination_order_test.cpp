#include "slam/smoother/elimination_order.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace stereobench::slam {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

// Mutation: sets handed on as they are, where all variables come last.
TEST(EliminationOrder, HoldsEachVariableOnce) {
  EXPECT_THAT(elimination_order({}, {}), IsEmpty());
  EXPECT_THAT(elimination_order(std::vector<std::vector<int>>{{0}}, std::vector<int>{1}), ElementsAre(0));
  EXPECT_THAT(elimination_order(std::vector<std::vector<int>>{{0, 1}}, std::vector<int>{1, 1}),
              UnorderedElementsAre(0, 1));
  EXPECT_THAT(elimination_order(std::vector<std::vector<int>>{{0, 1}, {1, 2}}, std::vector<int>{0, 0, 0}),
              UnorderedElementsAre(0, 1, 2));
}

// A star: its centre would tie all others to each other. Mutation: the order of the variables.
TEST(EliminationOrder, FillsInLittleAndKeepsTheLateOnesLast) {
  const std::vector<std::vector<int>> star{{0, 1}, {0, 2}, {0, 3}, {0, 4}};
  EXPECT_THAT(elimination_order(star, std::vector<int>{0, 0, 0, 0, 0}).front(), testing::Ne(0));
  EXPECT_EQ(elimination_order(star, std::vector<int>{0, 0, 1, 0, 0}).back(), 2);
}

}  // namespace
}  // namespace stereobench::slam
