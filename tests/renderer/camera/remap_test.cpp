/// Light gathered from between pixels, held to OpenCV's two steps that it does in one.

#include "renderer/camera/remap.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace stereobench::renderer {
namespace {

constexpr int kFirstRow = 7;  // of those that are there
constexpr int kWidth = 301, kHeight = 40;

/// Noise, blacks and whites: what rounds and what saturates.
cv::Mat noise(int type, std::uint64_t seed) {
  cv::Mat picture(97, 113, type);
  cv::RNG random(seed);
  random.fill(picture, cv::RNG::UNIFORM, -80, 335);
  return picture;
}

/// Places anywhere between the rows that are there, at all fractions.
cv::Mat places(std::uint64_t seed) {
  cv::Mat at(2 * kHeight, 2 * kWidth, CV_32FC2);
  cv::RNG random(seed);
  for (int v = 0; v < at.rows; ++v)
    for (int u = 0; u < at.cols; ++u)
      at.at<cv::Vec2f>(v, u) = {
          static_cast<float>(random.uniform(0, 32 * 110)) / 32.0F,
          static_cast<float>(kFirstRow) + static_cast<float>(random.uniform(0, 32 * 95)) / 32.0F};
  return at;
}

class Gather : public testing::TestWithParam<std::uint64_t> {};

// Mutations: no rounding; the ways to the next column and row taken for each other.
TEST_P(Gather, IsOpenCvsRemapAndMean) {
  const cv::Mat undistorted = noise(CV_8UC3, GetParam());
  const cv::Mat wanted = places(GetParam() + 100);
  cv::Mat pixels, fractions, dense, expected;
  cv::convertMaps(wanted, cv::noArray(), pixels, fractions, CV_16SC2);
  cv::remap(undistorted, dense, pixels - cv::Scalar(0, kFirstRow), fractions, cv::INTER_LINEAR);
  cv::resize(dense, expected, {kWidth, kHeight}, 0.0, 0.0, cv::INTER_AREA);
  cv::Mat distorted(kHeight, kWidth, CV_8UC3);
  for (int v = 0; v < kHeight; ++v) {
    const auto row = [&](int k) {
      return LightPlaces{pixels.ptr<cv::Vec2s>(2 * v + k), fractions.ptr<std::uint16_t>(2 * v + k)};
    };
    gather_light({row(0), row(1)}, {undistorted, kFirstRow}, distorted.ptr(v), kWidth);
  }
  EXPECT_EQ(cv::norm(distorted, expected, cv::NORM_INF), 0.0);
}

// The same of 16 bits, in double precision. Mutations: as above; weights of three places.
TEST_P(Gather, OfSixteenBitsIsTheMeanOfFourPlaces) {
  cv::Mat undistorted(97, 113, CV_16UC3);
  cv::RNG random(GetParam());
  random.fill(undistorted, cv::RNG::UNIFORM, -20000, 85000);
  cv::Mat pixels, fractions;
  cv::convertMaps(places(GetParam() + 100), cv::noArray(), pixels, fractions, CV_16SC2);
  cv::Mat distorted(kHeight, kWidth, CV_16UC3);
  for (int v = 0; v < kHeight; ++v) {
    const auto row = [&](int k) {
      return LightPlaces{pixels.ptr<cv::Vec2s>(2 * v + k), fractions.ptr<std::uint16_t>(2 * v + k)};
    };
    gather_light({row(0), row(1)}, {undistorted, kFirstRow}, distorted.ptr<std::uint16_t>(v), kWidth);
    for (int u = 0; u < kWidth; ++u) {
      cv::Vec3d sum;
      for (int k = 0; k < 4; ++k) {
        const cv::Vec2s& at = pixels.at<cv::Vec2s>(2 * v + k / 2, 2 * u + k % 2);
        const int fraction = fractions.at<std::uint16_t>(2 * v + k / 2, 2 * u + k % 2);
        const double right = fraction % 32 / 32.0, down = fraction / 32 / 32.0;
        const auto light = [&](int du, int dv) {
          return cv::Vec3d(undistorted.at<cv::Vec3w>(at[1] - kFirstRow + dv, at[0] + du));
        };
        sum += (1 - down) * ((1 - right) * light(0, 0) + right * light(1, 0)) +
               down * ((1 - right) * light(0, 1) + right * light(1, 1));
      }
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(distorted.at<cv::Vec3w>(v, u)[c], sum[c] / 4.0, 0.5) << u << ", " << v;
    }
  }
}

TEST_P(Gather, PicksThePixelsOfPlaces) {
  const cv::Mat undistorted = noise(CV_32FC1, GetParam());
  cv::Mat pixels, fractions;
  cv::convertMaps(places(GetParam()), cv::noArray(), pixels, fractions, CV_16SC2);
  std::vector<float> picked(kWidth);
  pick(pixels.ptr<cv::Vec2s>(3), {undistorted, kFirstRow}, picked.data(), kWidth);
  for (int u = 0; u < kWidth; ++u) {
    const cv::Vec2s& at = pixels.at<cv::Vec2s>(3, u);
    ASSERT_EQ(picked[static_cast<std::size_t>(u)], undistorted.at<float>(at[1] - kFirstRow, at[0])) << u;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Gather, testing::Range(std::uint64_t{0}, std::uint64_t{5}));

}  // namespace
}  // namespace stereobench::renderer
