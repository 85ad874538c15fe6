#include "vision/stereo/range_bearing.h"

#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "tests/vision/painter.h"
#include "vision/camera/rig.h"
#include "vision/stereo/sphere.h"

namespace stereobench::vision {
namespace {

constexpr double kRadius_m = 0.05;

OutlineCentres centres_of(const StereoRig& rig, const Eigen::Vector3d& ball, double sigma_px) {
  const Eigen::Matrix2d covariance = sigma_px * sigma_px * Eigen::Matrix2d::Identity();
  return {sphere_outline(rig.intrinsics, ball, kRadius_m)->centre_px,
          sphere_outline(rig.intrinsics, camera_point(rig, ball, Side::kRight), kRadius_m)->centre_px,
          covariance, covariance};
}

slam::RangeBearing measured(const StereoRig& rig, const OutlineCentres& centres,
                            const Eigen::Isometry3d& frame_from_camera) {
  const auto ball = triangulate_ball(rig, centres.left_px, centres.right_px, kRadius_m);
  return range_bearing(ball.value(), ball_covariance(rig, centres, kRadius_m), frame_from_camera);
}

double correlation(const Eigen::Matrix2d& c) {
  return c(0, 1) / std::sqrt(c(0, 0) * c(1, 1));
}

Eigen::Isometry3d frame_of_left_camera(const StereoRig& rig) {
  Eigen::Isometry3d result = robot_from_camera(rig);
  result.translation().setZero();
  return result;
}

// Catches: bearing right-positive, a baseline of the wrong sign, range not horizontal.
TEST(RangeBearing, IsHorizontalAndLeftPositiveFromTheRobot) {
  const StereoRig rig;
  const Eigen::Vector3d in_robot(3.0, 1.0, 0.7);
  const Eigen::Vector3d in_camera = robot_from_camera(rig).inverse() * in_robot;
  const auto result = range_bearing(in_camera, Eigen::Matrix3d::Identity(), robot_from_camera(rig));
  EXPECT_NEAR(result.range_m, std::sqrt(10.0), 1e-12);
  EXPECT_NEAR(result.bearing_rad, std::atan2(1.0, 3.0), 1e-12);
}

// Catches: any wrong derivative, diagonal covariance, transposed transform.
TEST(RangeBearing, CovarianceIsThatOfSmallPixelErrors) {
  painter::Dice dice(6);
  StereoRig rig;
  rig.pitch_down_rad = 0.15;
  for (int i = 0; i < 200; ++i) {
    const double z = dice.uniform(0.4, 8.0);
    const Eigen::Vector3d ball(dice.uniform(-0.5, 0.5) * z, dice.uniform(-0.4, 0.4) * z, z);
    OutlineCentres centres = centres_of(rig, ball, 0.0);
    centres.left_covariance_px2 << 0.04, 0.01, 0.01, 0.02;
    centres.right_covariance_px2 << 0.03, -0.005, -0.005, 0.05;
    const Eigen::Isometry3d frame = i % 2 == 0 ? robot_from_camera(rig) : frame_of_left_camera(rig);
    Eigen::Matrix<double, 2, 4> jacobian;  // by central differences
    for (int k = 0; k < 4; ++k) {
      OutlineCentres plus = centres;
      OutlineCentres minus = centres;
      (k < 2 ? plus.left_px : plus.right_px)(k % 2) += 1e-4;
      (k < 2 ? minus.left_px : minus.right_px)(k % 2) -= 1e-4;
      const auto a = measured(rig, plus, frame);
      const auto b = measured(rig, minus, frame);
      jacobian.col(k) = Eigen::Vector2d(a.range_m - b.range_m, a.bearing_rad - b.bearing_rad) / 2e-4;
    }
    Eigen::Matrix4d pixels = Eigen::Matrix4d::Zero();
    pixels.topLeftCorner<2, 2>() = centres.left_covariance_px2;
    pixels.bottomRightCorner<2, 2>() = centres.right_covariance_px2;
    const Eigen::Matrix2d expected = jacobian * pixels * jacobian.transpose();
    const Eigen::Matrix2d covariance = measured(rig, centres, frame).covariance;
    ASSERT_LT((covariance - expected).norm(), 1e-4 * expected.norm());
    ASSERT_EQ(covariance(0, 1), covariance(1, 0));
    ASSERT_GT(covariance.determinant(), 0.0);
  }
}

// Range falls with disparity uL - uR, left-positive bearing with uL: their errors share uL. (With bearings to
// the right the sign would be minus.) Catches: a diagonal covariance.
TEST(RangeBearing, ErrorsAreCorrelatedFromTheLeftCamera) {
  const StereoRig rig;
  const auto centres = centres_of(rig, {0.0, 0.0, 4.0}, 0.05);
  EXPECT_NEAR(correlation(measured(rig, centres, frame_of_left_camera(rig)).covariance), std::sqrt(0.5),
              0.01);
}

// Catches: the left camera's covariance reported for the robot, a baseline of the wrong sign (0.95).
TEST(RangeBearing, ErrorsAreNotCorrelatedFromTheMiddleOfTheBaseline) {
  const StereoRig rig;
  for (const double x : {0.06, 1.0, -1.5}) {
    const auto centres = centres_of(rig, {x, 0.0, 4.0}, 0.05);
    EXPECT_NEAR(correlation(measured(rig, centres, robot_from_camera(rig)).covariance), 0.0, 0.02) << x;
  }
}

TEST(RangeBearing, RangeSigmaGrowsWithTheSquareOfDepth) {
  const StereoRig rig;
  for (const double z : {2.0, 4.0, 8.0}) {
    const auto result = measured(rig, centres_of(rig, {0.06, 0.0, z}, 0.05), robot_from_camera(rig));
    const double expected = z * z * std::sqrt(2.0) * 0.05 / (rig.intrinsics.focal_px * rig.baseline_m);
    EXPECT_NEAR(std::sqrt(result.covariance(0, 0)), expected, 0.01 * expected);
  }
}

}  // namespace
}  // namespace stereobench::vision
