/// Rectified pictures. Mutations seen red here: a turn applied the other way round, to rays or to views; a
/// principal point that stays where it was in a larger picture; a view without the right camera's; a left
/// camera that is turned.

#include "vision/camera/rectify.h"

#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "slam/math/random.h"
#include "vision/camera/rig.h"

namespace stereobench::vision {
namespace {

StereoRig faulty_rig() {
  StereoRig rig;
  rig.intrinsics = {320, 240, 250.0, 161.0, 118.0};
  rig.right_turn_rad = {0.02, -0.05, 0.03};
  rig.distortion = {.k1 = -0.2, .k2 = 0.03, .p1 = 0.001, .p2 = -0.001};
  return rig;
}

// Where a point is in the picture that was taken, by way of the rectified rig and directly.
TEST(Rectification, TakesPointsToWhereTheyWereTaken) {
  StereoRig rig = faulty_rig();
  rig.distortion.pixel_aspect = 0.85;
  const Rectification rectification(rig);
  slam::RandomStream random(2, slam::Stream::kWorld);
  int seen = 0;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d point(2.0 * random.normal(), 1.5 * random.normal(), 1.0 + 4.0 * random.uniform());
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const Eigen::Vector3d in_camera = camera_point(rig, point, side);
      const Eigen::Vector2d taken = image_point(rig, in_camera);
      const auto undistorted = pinhole_point(rig, taken);
      const bool in_view = is_inside(rig.intrinsics, taken) && undistorted &&
                           (*undistorted - project(rig.intrinsics, in_camera)).norm() < 1e-6;
      if (!in_view) continue;
      ++seen;
      const Eigen::Vector2d rectified =
          project(rectification.rig().intrinsics, camera_point(rectification.rig(), point, side));
      EXPECT_LT((rectification.taken_px(rectified, side) - taken).norm(), 1e-9);
      EXPECT_TRUE(is_inside(rectification.rig().intrinsics, rectified)) << "all that is seen is kept";
    }
  }
  EXPECT_GT(seen, 500);
}

// A picture whose levels say where each pixel is.
// Law: without a lens that distorts, a place beyond the picture is where the pinhole has it; with one, places
// leave the picture without a jump. Mutation: one place for all that is not seen.
TEST(Rectification, GoesStraightOnBeyondThePicture) {
  StereoRig rig = faulty_rig();
  const Rectification distorted(rig);
  rig.distortion = {};
  const Rectification undistorted(rig);
  for (int i = -400; i < 800; ++i) {
    const Eigen::Vector2d at(i, 0.4 * i), next(i + 1.0, 0.4 * i);
    const Eigen::Vector3d ray = pixel_ray(undistorted.rig().intrinsics, at);
    const CameraModel right = cameras_of(rig)[1];
    EXPECT_LT((undistorted.taken_px(at, Side::kRight) - image_point(right, ray)).norm(), 1e-9) << i;
    const double step_px =
        distorted.taken_px(next, Side::kRight).x() - distorted.taken_px(at, Side::kRight).x();
    EXPECT_GT(step_px, 0.0) << i;
    EXPECT_LT(step_px, 2.0) << i;
  }
}

TEST(Rectification, MovesLightAsItMovesPoints) {
  const StereoRig rig = faulty_rig();
  const Rectification rectification(rig);
  cv::Mat ramp(rig.intrinsics.height_px, rig.intrinsics.width_px, CV_8UC3);
  for (int row = 0; row < ramp.rows; ++row) {
    for (int column = 0; column < ramp.cols; ++column) {
      ramp.at<cv::Vec3b>(row, column) = {cv::saturate_cast<uchar>(column / 2), cv::saturate_cast<uchar>(row),
                                         99};
    }
  }
  const StereoPair pair = rectification.apply({ramp, ramp});
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const cv::Mat& picture = side == Side::kLeft ? pair.left : pair.right;
    ASSERT_EQ(picture.cols, rectification.rig().intrinsics.width_px);
    int shown = 0;
    for (int row = 0; row < picture.rows; row += 7) {
      for (int column = 0; column < picture.cols; column += 7) {
        const Eigen::Vector2d at(column, row);
        const cv::Vec3b& level = picture.at<cv::Vec3b>(row, column);
        if (!rectification.shows(at, 3.0, side)) continue;
        ++shown;
        const Eigen::Vector2d taken = rectification.taken_px(at, side);
        EXPECT_NEAR(level[0], taken.x() / 2.0, 1.0);
        EXPECT_NEAR(level[1], taken.y(), 1.0);
        EXPECT_EQ(level[2], 99);
      }
    }
    EXPECT_GT(shown, 1000);
  }
}

/// Two different cameras that look a little apart.
CameraPair different_cameras() {
  CameraPair cameras;
  cameras[0] = {{320, 240, 250.0, 161.0, 118.0}, {.k1 = -0.2, .k2 = 0.03}};
  cameras[1] = {{320, 240, 262.0, 155.0, 123.0}, {.k1 = -0.15, .p1 = 0.002}};
  cameras[0].rectified_from_camera = Eigen::AngleAxisd(0.03, Eigen::Vector3d::UnitY()).matrix();
  cameras[1].rectified_from_camera = Eigen::AngleAxisd(-0.04, Eigen::Vector3d::UnitX()).matrix();
  return cameras;
}

// Law: two different cameras are rectified by their own lenses. A point that both see is on one row.
// Mutation: one camera's lens for both.
TEST(Rectification, RectifiesTwoDifferentCameras) {
  StereoRig rig;
  rig.intrinsics = {320, 240, 256.0, 158.0, 120.5};
  const CameraPair cameras = different_cameras();
  const Rectification rectification(rig, cameras);
  EXPECT_FALSE(rectification.is_nothing());
  EXPECT_EQ(rectification.rig().intrinsics.focal_px, 256.0);
  slam::RandomStream random(2, slam::Stream::kWorld);
  int seen = 0;
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d point(0.8 * random.normal(), 0.6 * random.normal(), 1.0 + 4.0 * random.uniform());
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const CameraModel& camera = cameras[static_cast<std::size_t>(side)];
      const Eigen::Vector3d in_frame = camera_point(rig, point, side);
      const Eigen::Vector3d in_camera = camera.rectified_from_camera.transpose() * in_frame;
      const StereoRig alone{.intrinsics = camera.intrinsics, .distortion = camera.lens};
      const Eigen::Vector2d taken = image_point(alone, in_camera);
      if (!is_inside(alone.intrinsics, taken) || in_camera.head<2>().norm() > in_camera.z()) continue;
      ++seen;
      const Eigen::Vector2d rectified = project(rectification.rig().intrinsics, in_frame);
      EXPECT_LT((rectification.taken_px(rectified, side) - taken).norm(), 1e-9);
      EXPECT_TRUE(is_inside(rectification.rig().intrinsics, rectified));
    }
  }
  EXPECT_GT(seen, 200);
}

TEST(Rectification, RefusesCamerasThatItCannotUse) {
  StereoRig rig;
  rig.intrinsics = {320, 240, 256.0, 158.0, 120.5};
  CameraPair mirrored = different_cameras();
  mirrored[0].rectified_from_camera = -Eigen::Matrix3d::Identity();
  EXPECT_THROW(Rectification(rig, mirrored), std::invalid_argument);
  CameraPair larger = different_cameras();
  larger[1].intrinsics.width_px = 640;
  EXPECT_THROW(Rectification(rig, larger), std::invalid_argument);
}

TEST(Rectification, CostsNothingWhereNothingIsWrong) {
  StereoRig rig = faulty_rig();
  rig.right_turn_rad.setZero();
  rig.distortion = {};
  const Rectification rectification(rig);
  const StereoPair pair = {cv::Mat::zeros(240, 320, CV_8UC3), cv::Mat::zeros(240, 320, CV_8UC3)};
  EXPECT_TRUE(rectification.is_nothing());
  EXPECT_EQ(rectification.apply(pair).left.data, pair.left.data);
  EXPECT_EQ(rectification.taken_px({17.25, 3.5}, Side::kRight), Eigen::Vector2d(17.25, 3.5));
  EXPECT_TRUE(rectification.shows({50.0, 50.0}, 50.4, Side::kLeft));
  EXPECT_FALSE(rectification.shows({50.0, 50.0}, 50.6, Side::kLeft));
}

TEST(Rectification, RefusesWhatItCannotUse) {
  StereoRig folded = faulty_rig();
  folded.distortion = {.k1 = -2.0};
  EXPECT_THROW(Rectification{folded}, std::invalid_argument);
  StereoRig nameless = faulty_rig();
  nameless.intrinsics.focal_px = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Rectification{nameless}, std::invalid_argument);
  const Rectification rectification(faulty_rig());
  EXPECT_THROW(rectification.apply({}), std::invalid_argument);
}

}  // namespace
}  // namespace stereobench::vision
