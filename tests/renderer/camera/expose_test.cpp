/// The camera's noise, measured against what was asked for.
///
/// Mutations seen red here: sd 2 % too large, rounding down instead of to nearest, both cameras from one
/// stream, the frame's index ignored, the high half of each word used twice.

#include "renderer/camera/expose.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "slam/math/random.h"

namespace stereobench::renderer {
namespace {

constexpr double kNoiseSigmas = 3.29;  // 99.9 % of a normal distribution lies within

StereoFrame grey(const cv::Size& size, int level) {
  const cv::Mat picture(size, CV_8UC3, cv::Scalar::all(level));
  return {{picture, {}, {}}, {picture.clone(), {}, {}}};
}

/// Differences from a grey level, as real numbers.
std::vector<double> noise_of(const cv::Mat& picture, int channel, int level) {
  std::vector<double> noise;
  for (auto pixel = picture.begin<cv::Vec3b>(); pixel != picture.end<cv::Vec3b>(); ++pixel) {
    noise.push_back(static_cast<double>((*pixel)[channel]) - level);
  }
  return noise;
}

double mean_product(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum / static_cast<double>(a.size());
}

class Noise : public testing::TestWithParam<double> {};

TEST_P(Noise, HasTheMeanAndVarianceThatWereAskedFor) {
  const double sd = GetParam();
  const vision::StereoPair pair = expose(grey({1024, 768}, 120), {sd}, 42, 3);
  for (const cv::Mat* picture : {&pair.left, &pair.right}) {
    for (int channel = 0; channel < 3; ++channel) {
      const std::vector<double> noise = noise_of(*picture, channel, 120);
      const double count = static_cast<double>(noise.size());
      const double mean = mean_product(noise, std::vector<double>(noise.size(), 1.0));
      const double variance = mean_product(noise, noise) - mean * mean;
      const double expected = sd * sd + 1.0 / 12.0;  // Sheppard: rounding is noise too
      EXPECT_NEAR(mean, 0.0, kNoiseSigmas * std::sqrt(expected / count));
      EXPECT_NEAR(variance, expected, kNoiseSigmas * expected * std::sqrt(2.0 / count));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, Noise, testing::Values(0.7, 1.0, 2.0, 4.0, 8.0));

TEST(Expose, ChannelsNeighboursCamerasAndFramesAreUncorrelated) {
  const StereoFrame frame = grey({1024, 768}, 120);
  const vision::StereoPair pair = expose(frame, {4.0}, 1, 17);
  const vision::StereoPair next = expose(frame, {4.0}, 1, 18);
  const std::vector<double> noise = noise_of(pair.left, 0, 120);
  std::vector<double> neighbour(noise.begin() + 1, noise.end());
  neighbour.push_back(0.0);
  const double largest = kNoiseSigmas * 16.0 / std::sqrt(static_cast<double>(noise.size()));
  EXPECT_LE(std::abs(mean_product(noise, noise_of(pair.left, 1, 120))), largest);
  EXPECT_LE(std::abs(mean_product(noise, noise_of(pair.left, 2, 120))), largest);
  EXPECT_LE(std::abs(mean_product(noise, noise_of(pair.right, 0, 120))), largest);
  EXPECT_LE(std::abs(mean_product(noise, noise_of(next.left, 0, 120))), largest);
  EXPECT_LE(std::abs(mean_product(noise, neighbour)), largest);
}

/// A picture of one level, its noise and the numbers of the stream: an independent way to the same picture.
void expect_numbers_of_stream(int level, double sd_levels) {
  const StereoFrame frame = grey({37, 5}, level);  // 555 bytes: does not end with a block
  const vision::StereoPair pair = expose(frame, {sd_levels}, 0x123456789abcULL, 17);
  slam::RandomStream words(0x123456789abcULL, slam::Stream::kImageNoise, 2 * 17 + 1);
  for (std::size_t i = 0; i < 555; i += 2) {
    const std::uint32_t word = words.bits();
    for (std::size_t half = 0; half < 2 && i + half < 555; ++half) {
      const double uniform = (static_cast<double>((word >> (16 * half)) & 0xffffU) + 0.5) / 65536.0;
      const double expected = std::clamp(level + sd_levels * slam::normal_quantile(uniform), 0.0, 255.0);
      ASSERT_NEAR(pair.right.data[i + half], expected, 0.52 + 1e-3 * sd_levels) << "byte " << i + half;
    }
  }
}

/// One half word a byte.
TEST(Expose, UsesTheNumbersOfTheImageNoiseStream) {
  expect_numbers_of_stream(100, 3.0);
}

/// Shifts beyond what a signed byte holds, either way, from the darkest and the brightest level. Mutations:
/// the first table alone; the first two.
TEST(Expose, AddsNoiseOfManyLevels) {
  for (const double sd_levels : {40.0, 60.0, 200.0}) {
    expect_numbers_of_stream(0, sd_levels);
    expect_numbers_of_stream(255, sd_levels);
  }
}

TEST(Expose, AFrameAloneGetsTheNoiseItHasInARun) {
  const StereoFrame frame = grey({64, 48}, 90);
  const auto differs = [](const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_L1) > 0.0; };
  const vision::StereoPair alone = expose(frame, {2.0}, 5, 17);
  for (std::uint64_t k = 0; k < 20; ++k) {
    const vision::StereoPair of_run = expose(frame, {2.0}, 5, k);
    EXPECT_EQ(differs(alone.left, of_run.left), k != 17);
    EXPECT_EQ(differs(alone.right, of_run.right), k != 17);
  }
  EXPECT_TRUE(differs(alone.left, expose(frame, {2.0}, 6, 17).left)) << "seeds";
}

TEST(Expose, ClampsAtBlackAndWhiteAndLeavesTheFrameAlone) {
  for (const int level : {0, 255}) {
    const StereoFrame frame = grey({64, 48}, level);
    const vision::StereoPair pair = expose(frame, {40.0}, 0, 0);
    const double kept = cv::norm(pair.left, frame.left.colour, cv::NORM_L1);
    EXPECT_NEAR(kept / (64 * 48 * 3), 40.0 / std::sqrt(2.0 * M_PI), 1.5);  // half the noise is cut off
    EXPECT_EQ(cv::countNonZero(frame.left.colour.reshape(1) != level), 0);
  }
}

TEST(Expose, WithoutNoiseIsTheFrameItself) {
  const StereoFrame frame = grey({8, 8}, 77);
  EXPECT_EQ(expose(frame, {0.0}, 0, 0).right.data, frame.right.colour.data);
}

TEST(Expose, RefusesNoiseThatMeansNothing) {
  EXPECT_THROW(expose(grey({8, 8}, 77), {-1.0}, 0, 0), std::invalid_argument);
  EXPECT_THROW(expose(grey({8, 8}, 77), {NAN}, 0, 0), std::invalid_argument);
  EXPECT_THROW(expose({}, {1.0}, 0, 0), std::invalid_argument);
}

}  // namespace
}  // namespace stereobench::renderer
