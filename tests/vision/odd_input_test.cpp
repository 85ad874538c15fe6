/// Pictures and rigs that are odd: an error of the caller's, or a right answer.
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/vision/painter.h"
#include "vision/camera/rig.h"
#include "vision/observe.h"

namespace stereobench::vision {
namespace {

StereoRig quarter_rig() {
  StereoRig rig;
  rig.intrinsics = {320, 240, 500.0, 159.5, 119.5};
  return rig;
}

StereoPair painted() {
  painter::Scene scene;
  scene.balls = {{{0.0, 0.0, 1.2}, 0, 0.05}, {{0.2, 0.1, 1.5}, 5, 0.05}};
  return painter::paint(scene, quarter_rig());
}

// Mutations: either camera's picture unchecked.
TEST(OddInput, PicturesThatAreNoneOfTheRigsAreRefused) {
  const StereoPair good = painted();
  const cv::Mat odd[] = {cv::Mat(),
                         cv::Mat(1, 1, CV_8UC3, cv::Scalar::all(0)),
                         cv::Mat(240, 320, CV_8UC1, cv::Scalar::all(0)),
                         cv::Mat(240, 320, CV_16UC3, cv::Scalar::all(0)),
                         cv::Mat(240, 320, CV_8UC4, cv::Scalar::all(0)),
                         cv::Mat(240, 321, CV_8UC3, cv::Scalar::all(0))};
  for (const cv::Mat& picture : odd) {
    EXPECT_THROW(observe({picture, good.right}, quarter_rig(), {}), std::invalid_argument);
    EXPECT_THROW(observe({good.left, picture}, quarter_rig(), {}), std::invalid_argument);
    EXPECT_THROW(find_outlines(picture, quarter_rig().intrinsics, {}), std::invalid_argument);
  }
  EXPECT_EQ(observe(good, quarter_rig(), {}).size(), 2U);
}

TEST(OddInput, RigsWithoutNumbersAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 6; ++i) {
    StereoRig rig = quarter_rig();
    (i == 0   ? rig.intrinsics.focal_px
     : i == 1 ? rig.intrinsics.cx_px
     : i == 2 ? rig.baseline_m
     : i == 3 ? rig.right_turn_rad[1]
     : i == 4 ? rig.distortion.pixel_aspect
              : rig.distortion.k1) = nan;
    EXPECT_THROW(observe(painted(), rig, {}), std::invalid_argument) << i;
    EXPECT_THROW(Rectification{rig}, std::invalid_argument) << i;
  }
}

// One pixel is a picture as well, of nothing.
TEST(OddInput, OnePixelShowsNothing) {
  const cv::Mat pixel(1, 1, CV_8UC3, cv::Scalar(0, 0, 229));
  StereoRig rig = quarter_rig();
  rig.intrinsics = {1, 1, 500.0, 0.0, 0.0};
  EXPECT_TRUE(observe({pixel, pixel}, rig, {}).empty());
}

// Cameras that are swapped see no ball before them. Mutation: outlines matched whichever lies to the left.
TEST(OddInput, SwappedCamerasMeasureNothing) {
  const StereoPair good = painted();
  EXPECT_TRUE(observe({good.right, good.left}, quarter_rig(), {}).empty());
}

}  // namespace
}  // namespace stereobench::vision
