// The bound on a disc's centre, against its closed form and against what nobody beats.
#include "harness/calibration/outline_bound.h"

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace stereobench::harness {
namespace {

constexpr double kPi = 3.14159265358979;

// sigma^2 / (A^2 pi r), A the length of the colour difference. The bound of pixels is a little larger than
// that of a continuous picture: the box filter leaves 2/3 of an edge's information where it falls between two
// pixels. Mutations: a channel left out; the variance for the deviation.
TEST(OutlineBound, IsThatOfADiscOfOneContrast) {
  const vision::Intrinsics camera;
  for (const double radius : {6.0, 15.0, 40.0}) {
    cv::Mat light(camera.height_px, camera.width_px, CV_8UC3, cv::Scalar(100, 100, 100));
    const Eigen::Vector2d centre(511.5, 383.5);
    cv::circle(light, cv::Point(512, 384), static_cast<int>(radius), cv::Scalar(160, 100, 20), cv::FILLED);
    const double contrast = std::hypot(60.0, 80.0);
    const vision::OutlineEllipse outline = {centre, radius, radius, 0.0};
    const auto bound = outline_bound(light, camera, outline, {.noise_sd_levels = 2.0});
    ASSERT_TRUE(bound);
    const double closed = 4.0 / (contrast * contrast * kPi * radius);
    EXPECT_GT((*bound)(0, 0) / closed, 0.98) << radius;
    EXPECT_LT((*bound)(0, 0) / closed, 1.5) << radius;
    EXPECT_NEAR((*bound)(1, 1) / (*bound)(0, 0), 1.0, 0.02);
    EXPECT_NEAR((*bound)(0, 1) / (*bound)(0, 0), 0.0, 0.05);
  }
}

TEST(OutlineBound, IsNothingWithoutContrast) {
  const vision::Intrinsics camera;
  const cv::Mat light(camera.height_px, camera.width_px, CV_8UC3, cv::Scalar(100, 100, 100));
  EXPECT_FALSE(outline_bound(light, camera, {{300.0, 300.0}, 20.0, 20.0, 0.0}, {.noise_sd_levels = 2.0}));
}

}  // namespace
}  // namespace stereobench::harness
