/// What the renderer promises besides exactness: which way is up, the same bytes again, and refusals.

#include "renderer/renderer.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/renderer/frames.h"
#include "tests/renderer/random_scene.h"

namespace stereobench::renderer {
namespace {

using test::same;

/// Mean place of a ball's pixels.
cv::Point2d place(const RenderedImage& frame, int id) {
  cv::Point2d sum;
  int count = 0;
  for (int v = 0; v < frame.ball_id.rows; ++v) {
    for (int u = 0; u < frame.ball_id.cols; ++u) {
      if (frame.ball_id.at<std::uint8_t>(v, u) == id) sum += cv::Point2d(u, v), ++count;
    }
  }
  return sum / count;
}

// Catches: swapped cameras, flipped rows, a mirrored camera.
TEST(Renderer, LeftIsLeftUpIsUpAndTheLeftCameraSeesNearThingsFartherRight) {
  worlds::World world;
  const double camera_m = test::small_rig().height_m;
  world.balls = {
      {{2.0, 0.4, camera_m}, 0.1, 0}, {{2.0, -0.4, camera_m}, 0.1, 1}, {{2.0, 0.0, camera_m + 0.3}, 0.1, 2}};
  const StereoFrame frame = Renderer(world, test::small_rig()).render({});
  EXPECT_LT(place(frame.left, 1).x, place(frame.left, 2).x - 50.0);
  EXPECT_LT(place(frame.left, 3).y, place(frame.left, 1).y - 20.0);
  for (const int id : {1, 2, 3}) {
    EXPECT_GT(place(frame.left, id).x, place(frame.right, id).x + 15.0);
    EXPECT_NEAR(place(frame.left, id).y, place(frame.right, id).y, 0.5);
  }
}

// Catches: red and blue exchanged.
TEST(Renderer, ColoursComeAsBlueGreenRed) {
  const worlds::World red = test::flat_sky({{{1.0, 0.0, 0.3}, 0.6, 0}});
  const StereoFrame frame = Renderer(red, test::small_rig()).render({});
  EXPECT_EQ(frame.left.colour.at<cv::Vec3b>(150, 200), cv::Vec3b(0, 0, 229));
}

// A background that looks like a ball would be the detector's fault only at first sight. The least saturated
// ball colour has (max - min) / max = 0.6.
TEST(Renderer, BackgroundsAreNearlyGrey) {
  worlds::World world = test::random_room(1);
  world.balls.clear();
  Renderer renderer(world, test::small_rig());
  for (const double heading_rad : {0.0, 1.6, 3.1, -1.6}) {
    const cv::Mat colour = renderer.render({0.0, 0.0, heading_rad}).left.colour;
    for (auto pixel = colour.begin<cv::Vec3b>(); pixel != colour.end<cv::Vec3b>(); ++pixel) {
      const auto [least, most] = std::minmax({(*pixel)[0], (*pixel)[1], (*pixel)[2]});
      ASSERT_GE(most, 40);
      ASSERT_LE(most - least, 0.27 * most);
    }
  }
}

// Catches: a shader that shades by the view instead of the light, or with the normal turned inward.
TEST(Renderer, BallsAreBrightWhereTheyFaceTheLight) {
  worlds::World world = test::flat_sky({{{1.0, 0.0, 0.3}, 0.2, 0}});
  world.light = {.towards_light = {0.0, 5.0, 0.0}, .ambient = 0.2, .diffuse = 0.8};  // from the robot's left
  vision::StereoRig rig = test::small_rig();
  rig.pitch_down_rad = 0.0;
  const cv::Mat red = Renderer(world, rig).render({}).left.colour;
  const int row = 161, centre = 211, near_rim = 65;  // the ball is 71 px in radius
  EXPECT_GT(red.at<cv::Vec3b>(row, centre - near_rim)[2], 180);
  EXPECT_NEAR(red.at<cv::Vec3b>(row, centre + near_rim)[2], 0.2 * 229, 1);
  EXPECT_NEAR(red.at<cv::Vec3b>(row, centre)[2], 0.2 * 229, 20) << "light grazes the middle";
}

TEST(Renderer, TheSamePoseGivesTheSameBytesAgainAndInOtherContexts) {
  const worlds::World world = test::random_room(2);
  Renderer first(world, test::small_rig());
  const StereoFrame frame = first.render(test::random_pose(2));
  Renderer second(world, test::small_rig());
  const StereoFrame elsewhere = second.render(test::random_pose(3));
  EXPECT_TRUE(same(frame, second.render(test::random_pose(2))));
  EXPECT_TRUE(same(frame, first.render(test::random_pose(2)))) << "the other context was used in between";
  EXPECT_FALSE(same(frame, elsewhere));
}

TEST(Renderer, CanBeMovedAndMadeManyTimes) {
  const worlds::World world = test::random_room(4);
  Renderer kept(world, test::small_rig());
  const StereoFrame frame = kept.render({});
  for (int i = 0; i < 5; ++i) {
    Renderer other(world, test::small_rig());
    std::swap(kept, other);
    EXPECT_TRUE(same(frame, other.render({})));
  }
  EXPECT_TRUE(same(frame, kept.render({})));
}

TEST(Renderer, AnEmptyWorldIsFloorAndSky) {
  const StereoFrame frame = Renderer({}, test::small_rig()).render({});
  EXPECT_TRUE(std::isinf(frame.left.depth_m.at<float>(0, 200)));
  EXPECT_LT(frame.left.depth_m.at<float>(299, 200), 1.0F);
  EXPECT_EQ(frame.left.colour.at<cv::Vec3b>(0, 200), cv::Vec3b(204, 199, 191));  // sky_rgb in levels
}

TEST(Renderer, ABallThatReachesTheCameraIsLeftOut) {
  worlds::World world;
  world.balls = {{{0.0, 0.0, 0.3}, 0.5, 0}, {{0.1, 0.0, 0.3}, 0.2, 1}};
  const StereoFrame frame = Renderer(world, test::small_rig()).render({});
  EXPECT_EQ(cv::countNonZero(frame.left.ball_id), 0);
}

TEST(Renderer, IdentitiesGoUpTo254) {
  worlds::World world = test::flat_sky(std::vector<worlds::Ball>(254));
  for (worlds::Ball& ball : world.balls) ball.centre_m = {-2.0, 0.0, 1.0};
  world.balls.back().centre_m = {1.0, 0.0, 1.2};
  const StereoFrame frame = Renderer(world, test::rig_looking_up()).render({});
  double most = 0.0;
  cv::minMaxLoc(frame.left.ball_id, nullptr, &most);
  EXPECT_EQ(most, 254.0);
  world.balls.push_back({});
  EXPECT_THROW(Renderer(world, test::small_rig()), std::invalid_argument);
}

TEST(Renderer, RefusesWorldsRigsAndPosesThatMeanNothing) {
  worlds::World world;
  world.balls = {{{1.0, 0.0, NAN}, 0.1, 0}};
  EXPECT_THROW(Renderer(world, test::small_rig()), std::invalid_argument);
  world.balls = {{{1.0, 0.0, 0.0}, 0.1, 18}};
  EXPECT_THROW(Renderer(world, test::small_rig()), std::invalid_argument);
  vision::StereoRig rig = test::small_rig();
  rig.intrinsics.focal_px = 0.0;
  EXPECT_THROW(Renderer({}, rig), std::invalid_argument);
  EXPECT_THROW(Renderer({}, test::small_rig()).render({NAN, 0.0, 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace stereobench::renderer
