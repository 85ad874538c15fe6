/// What is said of each ball against counting rays, one a pixel, also outside of the picture.
///
/// Mutations seen red here: counts by the outline's area; counts or boxes of the next identity; the ellipse's
/// centre for the projected one; rows that do not lean; borders through pixel centres; balls listed that are
/// out of view.

#include "renderer/truth/ball_truth.h"

#include <cmath>

#include <gtest/gtest.h>

#include "renderer/renderer.h"
#include "tests/renderer/random_scene.h"
#include "tests/renderer/ray_caster.h"

namespace stereobench::renderer {
namespace {

using vision::Side;

constexpr int kBeyond_px = 150;  // how far outside of the picture is counted

/// The pixels whose rays meet a ball, in the picture or around it.
PixelSet counted(const test::RayCaster& caster, int ball_id, const vision::Intrinsics& camera,
                 int beyond_px) {
  PixelSet set;
  for (int v = -beyond_px; v < camera.height_px + beyond_px; ++v) {
    for (int u = -beyond_px; u < camera.width_px + beyond_px; ++u) {
      if (caster.look(u, v).ball_id != ball_id) continue;
      ++set.count;
      set.box |= cv::Rect(u, v, 1, 1);
    }
  }
  return set;
}

void expect_same(const PixelSet& truth, long count, const cv::Rect& box, const std::string& what) {
  EXPECT_EQ(count, truth.count) << what;
  EXPECT_EQ(box, truth.box) << what;
}

class BallTruths : public testing::TestWithParam<std::uint64_t> {};

TEST_P(BallTruths, CountAndBoxThePixelsThatRaysCount) {
  const worlds::World world = test::random_room(GetParam());
  vision::StereoRig rig = test::small_rig();
  rig.right_turn_rad = {0.004, -0.007, 0.011};
  const slam::Pose pose = test::random_pose(GetParam());
  Renderer renderer(world, rig);
  const StereoFrame frame = renderer.render(pose);
  int balls = 0;
  for (const auto& [side, seen] :
       {std::pair(Side::kLeft, &frame.left), std::pair(Side::kRight, &frame.right)}) {
    test::RayCaster all(world, rig);
    all.stand_at(pose, side);
    for (const BallTruth& truth : ball_truths(world, camera_view(rig, side, pose), seen->ball_id)) {
      const worlds::Ball& ball = world.balls[static_cast<std::size_t>(truth.ball)];
      if (truth.outline.semi_major_px > kBeyond_px / 2) continue;
      test::RayCaster alone(worlds::World{.balls = {ball}}, rig);
      alone.stand_at(pose, side);
      const std::string what = "ball " + std::to_string(truth.ball);
      const PixelSet whole = counted(alone, 1, rig.intrinsics, kBeyond_px);
      const PixelSet inside = counted(alone, 1, rig.intrinsics, 0);
      const PixelSet visible = counted(all, truth.ball + 1, rig.intrinsics, 0);
      expect_same(whole, truth.px_count_all, truth.bbox_obj, what);
      expect_same(visible, truth.px_count_visib, truth.bbox_visib, what);
      EXPECT_DOUBLE_EQ(truth.visib_fract, double(visible.count) / double(whole.count));
      EXPECT_TRUE(inside.count == whole.count || truth.truncated) << what;
      const Eigen::Vector3d centre = all.in_camera(ball.centre_m);
      EXPECT_NEAR(truth.centre_px.x(),
                  rig.intrinsics.cx_px + rig.intrinsics.focal_px * centre.x() / centre.z(), 1e-9);
      EXPECT_NEAR(truth.centre_px.y(),
                  rig.intrinsics.cy_px + rig.intrinsics.focal_px * centre.y() / centre.z(), 1e-9);
      EXPECT_LT((truth.centre_in_camera_m - centre).norm(), 1e-12);
      ++balls;
    }
  }
  EXPECT_GE(balls, 4);
}

INSTANTIATE_TEST_SUITE_P(Rooms, BallTruths, testing::Range(std::uint64_t{0}, std::uint64_t{5}));

/// A ball before the left camera alone, at a place in its picture.
BallTruth ball_at(double u_px, double v_px, double radius_px) {
  const vision::StereoRig rig = test::rig_looking_up();
  const double depth_m = 2.0;
  const Eigen::Vector3d in_camera = depth_m * vision::pixel_ray(rig.intrinsics, {u_px, v_px});
  const worlds::Ball ball{vision::robot_from_camera(rig, Side::kLeft) * in_camera,
                          radius_px * depth_m / rig.intrinsics.focal_px, 0};
  const worlds::World world = test::flat_sky({ball});
  const StereoFrame frame = Renderer(world, rig).render({});
  return ball_truths(world, camera_view(rig, Side::kLeft, {}), frame.left.ball_id).at(0);
}

TEST(BallTruth, IsTruncatedFromTheFirstHundredthOfAPixelOn) {
  for (const double beyond_px : {-0.01, 0.01}) {
    double u_px = 10.0;
    for (int i = 0; i < 5; ++i) {  // moves the ball until its outline ends there
      const vision::OutlineEllipse outline = ball_at(u_px, 150.0, 10.0).outline;
      u_px -= outline.centre_px.x() - outline.half_extent_px().x() + 0.5 + beyond_px;
    }
    EXPECT_EQ(ball_at(u_px, 150.0, 10.0).truncated, beyond_px > 0.0);
  }
  const BallTruth half = ball_at(399.5, 150.0, 12.0);
  EXPECT_TRUE(half.truncated);
  EXPECT_NEAR(half.visib_fract, 0.5, 0.06);
  EXPECT_EQ(half.bbox_visib.br().x, 400);
  EXPECT_GT(half.bbox_obj.br().x, 408);
}

// An outline's centre is farther out than the projected centre, by (1 + b^2).
TEST(BallTruth, KnowsTheProjectedCentreFromTheOutlines) {
  const BallTruth truth = ball_at(350.0, 60.0, 40.0);
  EXPECT_NEAR(truth.centre_px.x(), 350.0, 1e-9);
  EXPECT_NEAR(truth.centre_px.y(), 60.0, 1e-9);
  EXPECT_GT(truth.outline.centre_px.x() - truth.centre_px.x(), 1.0);
  EXPECT_FALSE(truth.truncated);
}

TEST(BallTruth, SaysNothingOfBallsThatAreOutOfThePictureOrBehind) {
  const worlds::World world = test::flat_sky({{{-1.0, 0.0, 0.3}, 0.1, 0}, {{0.5, 5.0, 0.3}, 0.1, 0}});
  const vision::StereoRig rig = test::small_rig();
  const StereoFrame frame = Renderer(world, rig).render({});
  EXPECT_TRUE(ball_truths(world, camera_view(rig, Side::kLeft, {}), frame.left.ball_id).empty());
}

}  // namespace
}  // namespace stereobench::renderer
