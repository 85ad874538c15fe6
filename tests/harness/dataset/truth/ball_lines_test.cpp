#include "harness/dataset/truth/ball_lines.h"

#include <gmock/gmock.h>

#include "vision/palette.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

// Mutation: blue, green, red.
TEST(BallsCsv, NamesEachBallByItsPlaceInTheWorld) {
  worlds::World world;
  world.balls = {{{1.5, -2.0, 0.3}, 0.05, 4}, {{0.1, 0.2, 0.25}, 0.125, 0}};
  const auto rgb = vision::kPalette[4];
  EXPECT_THAT(balls_csv(world), HasSubstr("\n0,4," + std::to_string(rgb.r) + "," + std::to_string(rgb.g) +
                                          "," + std::to_string(rgb.b) + ",1.5,-2,0.3,0.05\n1,0,"));
  EXPECT_THAT(balls_csv(world), testing::EndsWith(",0.1,0.2,0.25,0.125\n"));
}

/// Two balls in numbers that decimals do not end at; nothing is seen of the second one.
std::vector<renderer::BallTruth> odd_truths() {
  renderer::BallTruth seen;
  seen.ball = 1;
  seen.centre_in_camera_m = {1.0 / 3.0, -0.1, 1e7 / 7.0};
  seen.centre_px = {-2.0 / 3.0, 1e-17};
  seen.outline = {{0.1 + 0.2, 5e5}, 12.0 / 7.0, 1.1, -3.0 / 7.0};
  seen.px_count_all = 1L << 40;
  seen.px_count_visib = 3;
  seen.visib_fract = 3.0 / static_cast<double>(1L << 40);
  seen.bbox_obj = {-70'000, -3, 100'000, 9};
  seen.bbox_visib = {0, 1, 2, 3};
  seen.truncated = true;
  renderer::BallTruth hidden = seen;
  hidden.ball = 0;
  hidden.px_count_visib = 0;
  hidden.bbox_visib = {};
  hidden.truncated = false;
  return {seen, hidden};
}

// Law: what is read back is what was written, to the last bit.
TEST(BallLines, AreReadBackExactly) {
  worlds::World world;
  world.balls = {{{1.5, -2.0, 0.3}, 0.05, 4}, {{0.1, 0.2, 0.25}, 0.125, 0}};
  const auto written = odd_truths();
  const auto read = parse_ball_lines(ball_lines(world, written), 2, "balls");
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].ball, written[i].ball);
    EXPECT_EQ(read[i].centre_in_camera_m, written[i].centre_in_camera_m);
    EXPECT_EQ(read[i].centre_px, written[i].centre_px);
    EXPECT_EQ(read[i].outline.centre_px, written[i].outline.centre_px);
    EXPECT_EQ(read[i].outline.semi_major_px, written[i].outline.semi_major_px);
    EXPECT_EQ(read[i].outline.semi_minor_px, written[i].outline.semi_minor_px);
    EXPECT_EQ(read[i].outline.angle_rad, written[i].outline.angle_rad);
    EXPECT_EQ(read[i].px_count_all, written[i].px_count_all);
    EXPECT_EQ(read[i].px_count_visib, written[i].px_count_visib);
    EXPECT_EQ(read[i].visib_fract, written[i].visib_fract);
    EXPECT_EQ(read[i].bbox_obj, written[i].bbox_obj);
    EXPECT_EQ(read[i].bbox_visib, written[i].bbox_visib);
    EXPECT_EQ(read[i].truncated, written[i].truncated);
  }
}

TEST(BallLines, SayWhichLineIsBroken) {
  worlds::World world;
  world.balls = {{{1.5, -2.0, 0.3}, 0.05, 4}, {{0.1, 0.2, 0.25}, 0.125, 0}};
  std::string lines = ball_lines(world, odd_truths());
  EXPECT_THAT([&] { parse_ball_lines(lines, 1, "left_balls/000000.jsonl"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("left_balls/000000.jsonl:1: ball_id: expected")));
  lines.replace(lines.rfind("truncated"), 9, "truncatet");
  EXPECT_THAT([&] { parse_ball_lines(lines, 2, "balls"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("balls:2: ")));
}

}  // namespace
}  // namespace stereobench::harness
