/// Memory is used again where nobody looks, and nowhere else.

#include "renderer/camera/picture_pool.h"

#include <set>

#include <gtest/gtest.h>

#include "renderer/renderer.h"
#include "tests/renderer/frames.h"
#include "tests/renderer/random_scene.h"

namespace stereobench::renderer {
namespace {

const cv::Size kSize(64, 48);

TEST(PicturePool, GivesTheSameMemoryOnceNobodyLooks) {
  PicturePool pool;
  const std::uint8_t* first = pool.take(kSize, CV_8UC3).data;
  EXPECT_EQ(pool.take(kSize, CV_8UC3).data, first);
}

// Property: whoever holds a picture, or a part of one, is its only holder.
// Mutation: no look at who holds it.
TEST(PicturePool, NeverGivesWhatSomebodyHolds) {
  PicturePool pool;
  std::vector<cv::Mat> held;
  std::set<const std::uint8_t*> places;
  for (int i = 0; i < 40; ++i) {
    held.push_back(pool.take(kSize, CV_8UC1).rowRange(i % 8, kSize.height));
    EXPECT_TRUE(places.insert(held.back().datastart).second) << i;
  }
}

// Mutations: a fit without the type, without the size.
TEST(PicturePool, GivesWhatWasAskedFor) {
  PicturePool pool;
  for (const int type : {CV_8UC1, CV_32FC1, CV_8UC3, CV_8UC1}) {
    for (const cv::Size& size : {kSize, cv::Size(48, 64), cv::Size(64, 47)}) {
      const cv::Mat picture = pool.take(size, type);
      EXPECT_EQ(picture.size(), size);
      EXPECT_EQ(picture.type(), type);
      EXPECT_TRUE(picture.isContinuous());
    }
  }
}

// The frame that is held stays what it was, and one that is dropped gives its memory to the next.
TEST(PicturePool, FramesOfARendererAreTheirHoldersAlone) {
  const worlds::World world = test::random_room(4);
  Renderer renderer(world, test::small_rig());
  const StereoFrame held = renderer.render(test::random_pose(4));
  const StereoFrame copy = {
      {held.left.colour.clone(), held.left.ball_id.clone(), held.left.depth_m.clone()},
      {held.right.colour.clone(), held.right.ball_id.clone(), held.right.depth_m.clone()}};
  std::set<const std::uint8_t*> places;
  for (std::uint64_t i = 0; i < 5; ++i) places.insert(renderer.render(test::random_pose(i)).left.colour.data);
  EXPECT_EQ(places.size(), 1U);
  EXPECT_TRUE(test::same(held, copy));
}

}  // namespace
}  // namespace stereobench::renderer
