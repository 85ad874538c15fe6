#include "vision/camera/rig.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/vision/painter.h"

namespace stereobench::vision {
namespace {

// Catches: a baseline of the wrong sign, swapped cameras.
TEST(Rig, CamerasStandHalfABaselineLeftAndRightOfTheRobot) {
  const StereoRig rig;
  const Eigen::Vector3d left = robot_from_camera(rig, Side::kLeft) * Eigen::Vector3d::Zero();
  const Eigen::Vector3d right = robot_from_camera(rig, Side::kRight) * Eigen::Vector3d::Zero();
  EXPECT_LT((left - Eigen::Vector3d(0.0, 0.06, 0.30)).norm(), 1e-12);
  EXPECT_LT((right - Eigen::Vector3d(0.0, -0.06, 0.30)).norm(), 1e-12);
}

TEST(Rig, LooksForwardWithXRightAndYDown) {
  const Eigen::Isometry3d robot_from_left = robot_from_camera(StereoRig{});
  EXPECT_LT((robot_from_left.linear() * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitX()).norm(), 1e-12);
  EXPECT_LT((robot_from_left.linear() * Eigen::Vector3d::UnitX() + Eigen::Vector3d::UnitY()).norm(), 1e-12);
  EXPECT_LT((robot_from_left.linear() * Eigen::Vector3d::UnitY() + Eigen::Vector3d::UnitZ()).norm(), 1e-12);
}

// Catches: a pitch of the wrong sign.
TEST(Rig, PitchedDownTheOpticalAxisMeetsTheFloor) {
  StereoRig rig;
  rig.pitch_down_rad = 0.3;
  const Eigen::Isometry3d robot_from_left = robot_from_camera(rig);
  const Eigen::Vector3d on_floor = robot_from_left * Eigen::Vector3d(0.0, 0.0, rig.height_m / std::sin(0.3));
  EXPECT_NEAR(on_floor.z(), 0.0, 1e-12);
  EXPECT_GT(on_floor.x(), 0.0);
  EXPECT_NEAR(robot_from_left.linear().determinant(), 1.0, 1e-12);
}

TEST(Rig, BothCamerasSeeTheSamePoint) {
  painter::Dice dice(4);
  StereoRig rig;
  rig.pitch_down_rad = 0.2;
  for (int i = 0; i < 100; ++i) {
    if (i == 50) rig.right_turn_rad = {0.01, -0.02, 0.03};
    const Eigen::Vector3d in_left(dice.uniform(-2, 2), dice.uniform(-2, 2), dice.uniform(0.5, 9));
    const Eigen::Vector3d in_right = camera_point(rig, in_left, Side::kRight);
    ASSERT_LT((robot_from_camera(rig) * in_left - robot_from_camera(rig, Side::kRight) * in_right).norm(),
              1e-12);
    if (i < 50) {
      ASSERT_GT(project(rig.intrinsics, in_left).x(), project(rig.intrinsics, in_right).x());
    }
  }
}

// Small turns: about x what is seen moves along the column, about y along the row.
TEST(Rig, ATurnedRightCameraSeesPointsElsewhere) {
  StereoRig rig;
  const Eigen::Vector3d ahead(rig.baseline_m, 0.0, 5.0);
  rig.right_turn_rad = {0.001, 0.0, 0.0};
  Eigen::Vector2d moved = project(rig.intrinsics, camera_point(rig, ahead, Side::kRight));
  EXPECT_NEAR(moved.x(), rig.intrinsics.cx_px, 1e-9);
  EXPECT_NEAR(moved.y(), rig.intrinsics.cy_px + 0.001 * rig.intrinsics.focal_px, 1e-3);
  rig.right_turn_rad = {0.0, 0.001, 0.0};
  moved = project(rig.intrinsics, camera_point(rig, ahead, Side::kRight));
  EXPECT_NEAR(moved.x(), rig.intrinsics.cx_px - 0.001 * rig.intrinsics.focal_px, 1e-3);
  EXPECT_NEAR(moved.y(), rig.intrinsics.cy_px, 1e-9);
}

// Catches: half a pixel in one of the two.
TEST(Projection, IsUndoneByThePixelsRay) {
  painter::Dice dice(5);
  const Intrinsics camera;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector2d pixel(dice.uniform(0, 1023), dice.uniform(0, 767));
    const Eigen::Vector3d point = dice.uniform(0.1, 20.0) * pixel_ray(camera, pixel);
    ASSERT_LT((project(camera, point) - pixel).norm(), 1e-9);
  }
}

// Catches: a principal point half a pixel off: a symmetric camera has it between the two middle pixels.
TEST(Projection, OpticalAxisMeetsTheMiddleOfTheImage) {
  const Eigen::Vector2d middle = project({}, {0.0, 0.0, 1.0});
  EXPECT_DOUBLE_EQ(middle.x(), 511.5);
  EXPECT_DOUBLE_EQ(middle.y(), 383.5);
}

TEST(Projection, IsEmptyForWhatTheCameraDoesNotSee) {
  EXPECT_TRUE(project_if_visible({}, {0.0, 0.0, 1.0}));
  EXPECT_FALSE(project_if_visible({}, {0.0, 0.0, -1.0}));
  EXPECT_FALSE(project_if_visible({}, {5.0, 0.0, 1.0}));
  EXPECT_FALSE(project_if_visible({}, {0.0, std::nan(""), 1.0}));
}

TEST(Rig, IsUsableOnlyWithFinitePositiveSizes) {
  EXPECT_TRUE(is_usable(StereoRig{}));
  StereoRig rig;
  rig.baseline_m = -0.12;
  EXPECT_FALSE(is_usable(rig));
  rig = {};
  rig.intrinsics.focal_px = std::nan("");
  EXPECT_FALSE(is_usable(rig));
}

}  // namespace
}  // namespace stereobench::vision
