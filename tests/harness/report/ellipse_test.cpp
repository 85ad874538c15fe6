#include "harness/report/ellipse.h"

#include <cmath>
#include <limits>

#include <Eigen/LU>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "slam/math/random.h"

namespace stereobench::harness {
namespace {

std::vector<cv::Point2f> as_contour(const std::vector<Eigen::Vector2d>& outline) {
  std::vector<cv::Point2f> contour;
  for (const Eigen::Vector2d& point : outline) {
    contour.emplace_back(static_cast<float>(point.x()), static_cast<float>(point.y()));
  }
  return contour;
}

// 20,000 draws: the share inside has a standard deviation of sqrt(0.95 * 0.05 / 20000) = 0.0015; the bound is
// four of them. Catches: the root of chi-square forgotten, one degree of freedom (3.84), eigenvectors
// transposed.
TEST(ReportEllipse, HoldsNinetyFivePercentOfTheGaussian) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    slam::RandomStream random(seed, slam::Stream::kWorld);
    const Eigen::Vector2d centre(random.normal(), random.normal());
    Eigen::Matrix2d factor;
    factor << random.normal(), random.normal(), 3.0 * random.normal(), random.normal();
    const std::vector<cv::Point2f> contour = as_contour(ellipse_95(centre, factor * factor.transpose()));
    int inside = 0;
    for (int i = 0; i < 20000; ++i) {
      const Eigen::Vector2d draw = centre + factor * Eigen::Vector2d(random.normal(), random.normal());
      const cv::Point2f point(static_cast<float>(draw.x()), static_cast<float>(draw.y()));
      inside += cv::pointPolygonTest(contour, point, false) >= 0.0 ? 1 : 0;
    }
    EXPECT_NEAR(inside / 20000.0, 0.95, 0.006);
  }
}

TEST(ReportEllipse, LiesAtOneMahalanobisDistance) {
  Eigen::Matrix2d covariance;
  covariance << 4.0, 1.5, 1.5, 1.0;
  for (const Eigen::Vector2d& point : ellipse_95({1.0, 2.0}, covariance)) {
    const Eigen::Vector2d off = point - Eigen::Vector2d(1.0, 2.0);
    EXPECT_NEAR(off.dot(covariance.inverse() * off), -2.0 * std::log(0.05), 1e-9);
  }
}

TEST(ReportEllipse, DegeneratesWithoutComplaint) {
  for (const Eigen::Vector2d& point : ellipse_95({1.0, 2.0}, Eigen::Matrix2d::Zero())) {
    EXPECT_TRUE(point.isApprox(Eigen::Vector2d(1.0, 2.0)));
  }
  for (const Eigen::Vector2d& point : ellipse_95({0.0, 0.0}, -Eigen::Matrix2d::Identity())) {
    EXPECT_TRUE(point.isZero());
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(ellipse_95({nan, 0.0}, Eigen::Matrix2d::Identity()).empty());
  EXPECT_TRUE(ellipse_95({0.0, 0.0}, Eigen::Matrix2d::Constant(nan)).empty());
}

}  // namespace
}  // namespace stereobench::harness
