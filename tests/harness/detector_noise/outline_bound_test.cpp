// The bound on a disc's centre, against the information of its pixels and a blurred edge's closed form.
#include "harness/detector_noise/outline_bound.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace stereobench::harness {
namespace {

constexpr double kPi = 3.14159265358979;

/// Length of the disc's chord within the pixel (x, y), at the ordinate `v`.
double chord_px(double x, double v, const Eigen::Vector2d& centre, double radius_px) {
  const double half2 = radius_px * radius_px - (v - centre.y()) * (v - centre.y());
  if (half2 <= 0.0) return 0.0;
  const double low = std::max(x - 0.5, centre.x() - std::sqrt(half2));
  const double high = std::min(x + 0.5, centre.x() + std::sqrt(half2));
  return std::max(0.0, high - low);
}

/// Share of the pixel (x, y) that the disc covers, by the midpoint rule over 400 chords.
double covered(double x, double y, const Eigen::Vector2d& centre, double radius_px) {
  constexpr int kChords = 400;
  double sum = 0.0;
  for (int i = 0; i < kChords; ++i)
    sum += chord_px(x, y - 0.5 + (i + 0.5) / kChords, centre, radius_px) / kChords;
  return sum;
}

/// Fisher information of the disc's column from the box-filtered pixels of a contrast of 1 and a noise of 1:
/// the sum of the squares of their derivatives, by central differences.
double information_of_column(const Eigen::Vector2d& centre, double radius_px) {
  constexpr double kStep_px = 0.01;
  const Eigen::Vector2d step(kStep_px, 0.0);
  const int reach = static_cast<int>(radius_px) + 2;
  const Eigen::Vector2i middle = centre.array().round().cast<int>();
  double information = 0.0;
  for (int y = middle.y() - reach; y <= middle.y() + reach; ++y) {
    for (int x = middle.x() - reach; x <= middle.x() + reach; ++x) {
      const double change = covered(x, y, centre + step, radius_px) - covered(x, y, centre - step, radius_px);
      information += std::pow(change / (2.0 * kStep_px), 2);
    }
  }
  return information;
}

constexpr double kContrast = 100.0;  // of (160, 100, 20) to (100, 100, 100)
constexpr double kNoise = 2.0;

cv::Mat disc_at(const cv::Point& centre, double radius_px) {
  const vision::Intrinsics camera;
  cv::Mat light(camera.height_px, camera.width_px, CV_8UC3, cv::Scalar(100, 100, 100));
  cv::circle(light, centre, static_cast<int>(radius_px), cv::Scalar(160, 100, 20), cv::FILLED);
  return light;
}

// The bound takes each pixel's piece of rim for straight, which costs 3 % where outlines have 6 px.
// Mutations: a channel left out (1.25 or 1.67 times); the noise's deviation for its variance (0.71 times).
TEST(OutlineBound, IsThatOfBoxFilteredPixels) {
  for (const double radius : {6.0, 15.0, 40.0}) {
    for (const Eigen::Vector2d& centre : {Eigen::Vector2d(511.5, 383.5), Eigen::Vector2d(511.8, 384.1)}) {
      const auto bound = outline_bound(disc_at({512, 384}, radius), vision::Intrinsics{},
                                       {centre, radius, radius, 0.0}, {.noise_sd_levels = kNoise});
      ASSERT_TRUE(bound);
      const double sd_px = kNoise / kContrast / std::sqrt(information_of_column(centre, radius));
      EXPECT_NEAR(std::sqrt((*bound)(0, 0)) / sd_px, 1.0, radius < 10.0 ? 0.035 : 0.01) << radius;
      EXPECT_NEAR((*bound)(0, 1) / (*bound)(0, 0), 0.0, 0.05) << radius;
    }
  }
}

// A straight edge under a Gaussian of s px has the slope's square integrated over the edge, 1 / (2 sqrt(pi)
// s), in place of 1 or 2/3; the pixel's box adds 1/12 to s^2. Mutation: the blur left out (3.6 times).
TEST(OutlineBound, OfABlurredEdgeGrowsWithTheBlur) {
  constexpr double kRadius = 40.0;
  for (const double blur : {0.8, 1.5}) {
    const auto bound =
        outline_bound(disc_at({512, 384}, kRadius), vision::Intrinsics{},
                      {{511.5, 383.5}, kRadius, kRadius, 0.0}, {.noise_sd_levels = kNoise, .blur_px = blur});
    ASSERT_TRUE(bound);
    const double slope2 = 1.0 / (2.0 * std::sqrt(kPi) * std::sqrt(blur * blur + 1.0 / 12.0));
    const double closed = kNoise * kNoise / (kContrast * kContrast * kPi * kRadius * slope2);
    EXPECT_NEAR((*bound)(0, 0) / closed, 1.0, 0.02) << blur;
  }
}

TEST(OutlineBound, IsNothingWithoutContrast) {
  const vision::Intrinsics camera;
  const cv::Mat light(camera.height_px, camera.width_px, CV_8UC3, cv::Scalar(100, 100, 100));
  EXPECT_FALSE(outline_bound(light, camera, {{300.0, 300.0}, 20.0, 20.0, 0.0}, {.noise_sd_levels = 2.0}));
}

}  // namespace
}  // namespace stereobench::harness
