// The bound on range for balls of known size, against closed forms of discs with one contrast all around.
#include "harness/detector_noise/ball_bound.h"

#include <cmath>

#include <gtest/gtest.h>

namespace stereobench::harness {
namespace {

const vision::StereoRig kRig;
constexpr double kOfColumn = 1e4;  // information, 1 / px^2: twice that is the radius'

BallBounds bounds_of(double depth_m, double radius_m, double radius_sd_m) {
  const vision::SizedBall ball(0.5 * kRig.baseline_m, 0.0, depth_m, radius_m);
  const Eigen::Matrix3d camera = Eigen::Vector3d(kOfColumn, kOfColumn, 2.0 * kOfColumn).asDiagonal();
  return ball_bounds(kRig, ball, radius_sd_m, {camera, camera});
}

double sd(const Eigen::Matrix2d& bound) {
  return std::sqrt(bound(0, 0));
}

// Mutations: one camera's radius left out (1.41 and 1.80); the radius' information not twice the column's.
TEST(BallBound, OfAKnownSizeIsLowerByWhatTheSizeTells) {
  for (const double radius_m : {0.06, 0.09}) {
    const double closed = std::sqrt(1.0 + 8.0 * std::pow(radius_m / kRig.baseline_m, 2));
    for (const double depth_m : {2.0, 4.0, 8.0}) {
      const BallBounds bounds = bounds_of(depth_m, radius_m, 0.0);
      EXPECT_NEAR(sd(bounds.unknown_size) / sd(bounds.of_size), closed, 0.02) << depth_m;
    }
  }
}

// sigma_Z = Z^2 sqrt(2) sigma_u / (f B), and beside it the tolerance's share, Z sd / R.
TEST(BallBound, GoesFromOneToTheOtherWithTheTolerance) {
  constexpr double kDepth_m = 4.0, kRadius_m = 0.06;
  const double f = kRig.intrinsics.focal_px;
  const double by_disparity = kDepth_m * kDepth_m * std::sqrt(2.0 / kOfColumn) / (f * kRig.baseline_m);
  EXPECT_NEAR(sd(bounds_of(kDepth_m, kRadius_m, 0.0).unknown_size) / by_disparity, 1.0, 0.01);
  for (const double tolerance_m : {0.0, 1e-5, 1e-4, 1e-3, 1e-2}) {
    const double by_size = std::sqrt(std::pow(kDepth_m * kDepth_m / (f * kRadius_m), 2) / (4.0 * kOfColumn) +
                                     std::pow(kDepth_m * tolerance_m / kRadius_m, 2));
    const double closed = 1.0 / std::sqrt(std::pow(by_disparity, -2) + std::pow(by_size, -2));
    EXPECT_NEAR(sd(bounds_of(kDepth_m, kRadius_m, tolerance_m).of_size) / closed, 1.0, 0.01) << tolerance_m;
  }
}

TEST(BallBound, IsNothingWhereACameraTellsNothing) {
  const vision::SizedBall ball(0.0, 0.0, 2.0, 0.06);
  const BallBounds bounds =
      ball_bounds(kRig, ball, 0.0, {Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Zero()});
  EXPECT_TRUE(bounds.of_size.isZero(0.0) && bounds.unknown_size.isZero(0.0));
}

}  // namespace
}  // namespace stereobench::harness
