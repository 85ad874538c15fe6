/// The fit of a rig to what two cameras saw of a board.
#include "harness/rig_calibration/rig_fit.h"

#include <cmath>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/rig_calibration/rectified_rig.h"
#include "tests/harness/rig_calibration/board_views.h"

namespace stereobench::harness {

static void PrintTo(RigModel model, std::ostream* out) {
  *out << (model == RigModel::kOneCamera ? "one camera" : "two cameras");
}

namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr Board kFitBoard{9, 6, 0.03};

RigFitSettings fit_settings(const vision::StereoRig& rig, RigModel model) {
  return {.board = kFitBoard,
          .width_px = rig.intrinsics.width_px,
          .height_px = rig.intrinsics.height_px,
          .model = model};
}

/// The same rig with pixels that are not square.
vision::StereoRig stretched_rig() {
  vision::StereoRig rig = test::faulty_rig();
  rig.distortion.pixel_aspect = 0.9;
  return rig;
}

class RigFits : public testing::TestWithParam<RigModel> {};

// Law: without noise the rig is found again. Points come from vision::image_point, the fit has equations of
// its own. Mutations: p1 and p2 exchanged; the aspect that of columns.
TEST_P(RigFits, FindTheRigThatTheCornersWereSeenThrough) {
  const vision::StereoRig rig = stretched_rig();
  const auto views = test::seen_through(rig, kFitBoard, test::board_places(kFitBoard, 8, 1), 0.0, 1);
  RigFitSettings settings = fit_settings(rig, GetParam());
  settings.square_pixels = false;
  const RigFit fit = fit_rig(views, settings);
  EXPECT_LT(fit.rms_px, 1e-6);
  for (const CameraParameters& camera : fit.cameras) {
    EXPECT_NEAR(camera[0], rig.intrinsics.focal_px, 1e-4);
    EXPECT_NEAR(camera[1], rig.intrinsics.cx_px, 1e-4);
    EXPECT_NEAR(camera[2], rig.intrinsics.cy_px, 1e-4);
    EXPECT_NEAR(camera[3], rig.distortion.k1, 1e-6);
    EXPECT_NEAR(camera[4], rig.distortion.k2, 1e-5);
    EXPECT_NEAR(camera[5], rig.distortion.p1, 1e-7);
    EXPECT_NEAR(camera[6], rig.distortion.p2, 1e-7);
    EXPECT_EQ(camera[kK3], 0.0);
    EXPECT_NEAR(camera[kAspect], rig.distortion.pixel_aspect, 1e-7);
  }
  EXPECT_LT((fit.right_in_left_m - Eigen::Vector3d(rig.baseline_m, 0, 0)).norm(), 1e-7);
  const RigCalibration calibration = rectified_rig(fit, GetParam(), 1024, 768);
  EXPECT_NEAR(calibration.rig.baseline_m, rig.baseline_m, 1e-7);
  if (GetParam() == RigModel::kOneCamera) {
    EXPECT_LT((calibration.rig.right_turn_rad - rig.right_turn_rad).norm(), 1e-7);
  }
}

// Law: errors are as large as the fit says. The mean square of n deviations of unit size is 1 within a few
// times sqrt(2 / n); those of one fit hang together, and its fifteen or more count for four.
// Mutations: variances that are twice as large, or half.
TEST_P(RigFits, KnowHowFarTheyAreOff) {
  constexpr int kSeeds = 24;
  const vision::StereoRig rig = stretched_rig();
  RigFitSettings settings = fit_settings(rig, GetParam());
  settings.square_pixels = false;
  double squares = 0.0;
  double count = 0.0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const auto views = test::seen_through(rig, kFitBoard, test::board_places(kFitBoard, 6, seed), 0.2, seed);
    const RigFit fit = fit_rig(views, settings);
    EXPECT_NEAR(fit.neighbour_sd_px, 0.2, 0.02);
    EXPECT_NEAR(fit.corner_sd_px, 0.2, 4.0 * 0.2 / std::sqrt(2.0 * 6 * 54 * 4));
    for (const double deviation : test::deviations(fit, rig, GetParam())) {
      squares += deviation * deviation;
      count += 1.0;
      EXPECT_LT(std::abs(deviation), 4.5);
    }
  }
  EXPECT_NEAR(squares / count, 1.0, 3.0 * std::sqrt(2.0 / (4.0 * kSeeds)));
}

INSTANTIATE_TEST_SUITE_P(Models, RigFits, testing::Values(RigModel::kTwoCameras, RigModel::kOneCamera));

// Mutation: the loss left out.
TEST(RigFit, RobustlyPassesOverCornersThatAreFarOff) {
  const vision::StereoRig rig = test::faulty_rig();
  auto views = test::seen_through(rig, kFitBoard, test::board_places(kFitBoard, 8, 3), 0.1, 3);
  for (Eigen::Vector2d& corner : views[2].corners_px[1]) corner += Eigen::Vector2d(4.0, 9.0);
  RigFitSettings settings = fit_settings(rig, RigModel::kTwoCameras);
  settings.robust = true;
  const RigFit fit = fit_rig(views, settings);
  for (std::size_t view = 0; view < views.size(); ++view)
    EXPECT_EQ(fit.view_rms_px[view][0] + fit.view_rms_px[view][1] > 1.0, view == 2) << view;
}

TEST(RigFit, RefusesViewsThatSayTooLittle) {
  const vision::StereoRig rig = test::faulty_rig();
  const RigFitSettings settings = fit_settings(rig, RigModel::kTwoCameras);
  const auto two = test::seen_through(rig, kFitBoard, test::board_places(kFitBoard, 2, 1), 0.1, 1);
  EXPECT_THAT([&] { fit_rig(two, settings); },
              ThrowsMessage<std::runtime_error>(HasSubstr("at least 3 views of the board (got 2)")));
  // A board that is held up straight, again and again: neither depth nor focal length can be told.
  std::vector<Eigen::Isometry3d> parallel(5, Eigen::Isometry3d::Identity());
  for (std::size_t i = 0; i < parallel.size(); ++i)
    parallel[i].translation() = Eigen::Vector3d(-0.1 + 0.03 * static_cast<double>(i), -0.08, 0.7);
  vision::StereoRig rectified = rig;
  rectified.right_turn_rad.setZero();
  rectified.distortion = {};
  const auto flat = test::seen_through(rectified, kFitBoard, parallel, 0.1, 1);
  EXPECT_THAT([&] { fit_rig(flat, settings); },
              ThrowsMessage<std::runtime_error>(HasSubstr("the views do not determine")));
}

// Mutation: the baseline's sign not looked at.
TEST(RectifiedRig, SaysThatLeftAndRightAreSwapped) {
  const vision::StereoRig rig = test::faulty_rig();
  auto views = test::seen_through(rig, kFitBoard, test::board_places(kFitBoard, 6, 1), 0.1, 1);
  for (BoardView& view : views) std::swap(view.corners_px[0], view.corners_px[1]);
  for (const RigModel model : {RigModel::kTwoCameras, RigModel::kOneCamera}) {
    const RigFit fit = fit_rig(views, fit_settings(rig, model));
    EXPECT_THAT([&] { rectified_rig(fit, model, 1024, 768); },
                ThrowsMessage<std::runtime_error>(HasSubstr("left and right are swapped")));
  }
}

// Law: once rectified, both cameras see a point on one row, and its disparity is f B / Z.
// Mutation: the right camera's turn the other way round in the fit.
TEST(RectifiedRig, PutsPointsOnOneRow) {
  const vision::StereoRig rig = stretched_rig();
  const auto places = test::board_places(kFitBoard, 6, 5);
  const auto views = test::seen_through(rig, kFitBoard, places, 0.0, 1);
  for (const RigModel model : {RigModel::kTwoCameras, RigModel::kOneCamera}) {
    RigFitSettings settings = fit_settings(rig, model);
    settings.square_pixels = false;
    const RigFit fit = fit_rig(views, settings);
    const RigCalibration calibration = rectified_rig(fit, model, 1024, 768);
    for (std::size_t i = 0; i < views.front().corners_px[0].size(); ++i) {
      const auto left = rectified_px(calibration, views.front().corners_px[0][i], vision::Side::kLeft);
      const auto right = rectified_px(calibration, views.front().corners_px[1][i], vision::Side::kRight);
      ASSERT_TRUE(left && right);
      EXPECT_NEAR(left->y(), right->y(), 1e-5);
      const double disparity = left->x() - right->x();
      const double depth_m = calibration.rig.intrinsics.focal_px * calibration.rig.baseline_m / disparity;
      const Eigen::Vector3d truth = places.front() * kFitBoard.corner_m(static_cast<int>(i));
      const double distance_m = (depth_m * vision::pixel_ray(calibration.rig.intrinsics, *left)).norm();
      EXPECT_NEAR(distance_m, truth.norm(), 1e-5);
    }
  }
}

}  // namespace
}  // namespace stereobench::harness
