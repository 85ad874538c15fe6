#include "harness/dataset/truth/ball_lines.h"

#include <gmock/gmock.h>

#include "vision/palette.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;

// Mutation: blue, green, red.
TEST(BallsCsv, NamesEachBallByItsPlaceInTheWorld) {
  worlds::World world;
  world.balls = {{{1.5, -2.0, 0.3}, 0.05, 4}, {{0.1, 0.2, 0.25}, 0.125, 0}};
  const auto rgb = vision::kPalette[4];
  EXPECT_THAT(balls_csv(world), HasSubstr("\n0,4," + std::to_string(rgb.r) + "," + std::to_string(rgb.g) +
                                          "," + std::to_string(rgb.b) + ",1.5,-2,0.3,0.05\n1,0,"));
  EXPECT_THAT(balls_csv(world), testing::EndsWith(",0.1,0.2,0.25,0.125\n"));
}

}  // namespace
}  // namespace stereobench::harness
