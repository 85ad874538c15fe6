/// The camera, each part measured against what was asked for.
///
/// Mutations seen red here: electrons not scaled by the exposure, read noise 1.8 times too large, white
/// balance in the order of BGR, the third moment's sign, the vignette linear in the radius, a Gaussian cut
/// off at one and a half standard deviations, sRGB straight for ten times as far, shot and read noise from
/// one stream.

#include "renderer/camera/sensor_model.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "renderer/camera/expose.h"

namespace stereobench::renderer {
namespace {

using worlds::CameraSensor;
using worlds::Encoding;

constexpr double kSensorSigmas = 3.29;  // 99.9 % of a normal distribution lies within

cv::Mat grey_picture(const cv::Size& size, double level) {
  return {size, CV_8UC3, cv::Scalar::all(level)};
}

struct Moments {
  double count = 0.0;
  double mean = 0.0;
  double variance = 0.0;
  double third = 0.0;  ///< central
};

Moments moments_of(const cv::Mat& picture, int channel) {
  std::array<double, 256> histogram{};
  for (auto pixel = picture.begin<cv::Vec3b>(); pixel != picture.end<cv::Vec3b>(); ++pixel)
    ++histogram[(*pixel)[channel]];
  Moments moments{.count = static_cast<double>(picture.total())};
  for (std::size_t i = 0; i < 256; ++i) moments.mean += histogram[i] * static_cast<double>(i) / moments.count;
  for (std::size_t i = 0; i < 256; ++i) {
    const double off = static_cast<double>(i) - moments.mean;
    moments.variance += histogram[i] * off * off / moments.count;
    moments.third += histogram[i] * off * off * off / moments.count;
  }
  return moments;
}

class GreyLevels : public testing::TestWithParam<int> {};

// A chip of 4000 electrons, 12 of them read noise, half exposed and twice amplified: the photon transfer
// curve.
TEST_P(GreyLevels, HaveTheMeanAndVarianceOfPhotonsAndReading) {
  const CameraSensor sensor{
      .exposure = 0.5, .full_well_electrons = 4000.0, .read_noise_electrons = 12.0, .gain = 1.8};
  const double electrons = GetParam() / 255.0 * 0.5 * 4000.0;
  const double levels_per_electron = 1.8 * 255.0 / 4000.0;
  const double variance = levels_per_electron * levels_per_electron * (electrons + 144.0);
  const cv::Mat picture = develop(grey_picture({1024, 768}, GetParam()), sensor, 42, 3);
  for (int channel = 0; channel < 3; ++channel) {
    const Moments seen = moments_of(picture, channel);
    const double expected = variance + 1.0 / 12.0;  // Sheppard: rounding is noise too
    EXPECT_NEAR(seen.mean, levels_per_electron * electrons, kSensorSigmas * std::sqrt(expected / seen.count));
    EXPECT_NEAR(seen.variance, expected, kSensorSigmas * expected * std::sqrt(2.0 / seen.count));
  }
  EXPECT_NEAR(noise_sd_levels(sensor, GetParam()), std::sqrt(variance), 1e-12);
}
INSTANTIATE_TEST_SUITE_P(Chip, GreyLevels, testing::Values(40, 60, 80, 100, 130, 160, 190, 220));

// One electron a level: the count itself is stored. Both sides of the change from inversion to moments.
TEST(Develop, CountsPhotonsAsPoissonDoes) {
  const CameraSensor sensor{.full_well_electrons = 255.0};
  for (const double expected : {1.0, 5.0, 15.0, 17.0, 40.0}) {
    const Moments seen = moments_of(develop(grey_picture({1024, 768}, expected), sensor, 7, 0), 1);
    const double rounding = expected < 16.0 ? 0.0 : 1.0 / 12.0;
    EXPECT_NEAR(seen.mean, expected, kSensorSigmas * std::sqrt(expected / seen.count)) << expected;
    const double variance_sd = std::sqrt((2.0 * expected * expected + expected) / seen.count);
    EXPECT_NEAR(seen.variance, expected + rounding, kSensorSigmas * variance_sd) << expected;
    const double third_sd = std::sqrt(20.0 * expected * expected * expected / seen.count);
    EXPECT_NEAR(seen.third, expected, kSensorSigmas * third_sd) << expected;
  }
}

TEST(Develop, GivesEachCountOfFewPhotonsItsProbability) {
  const cv::Mat picture = develop(grey_picture({1024, 768}, 2.0), {.full_well_electrons = 255.0}, 1, 0);
  double probability = std::exp(-2.0);
  for (int count = 0; count < 8; ++count) {
    const double n = static_cast<double>(3 * picture.total());
    EXPECT_NEAR(cv::countNonZero(picture.reshape(1) == count), n * probability,
                kSensorSigmas * std::sqrt(n * probability) + n / 65536.0)
        << count;
    probability *= 2.0 / (count + 1);
  }
}

TEST(Develop, ChannelsNeighboursAndCamerasAreUncorrelated) {
  const CameraSensor sensor{.full_well_electrons = 2000.0, .read_noise_electrons = 40.0};
  const cv::Mat light = grey_picture({1024, 768}, 120);
  cv::Mat left, right;
  develop(light, sensor, 1, 34).convertTo(left, CV_64F, 1.0, -120.0);
  develop(light, sensor, 1, 35).convertTo(right, CV_64F, 1.0, -120.0);
  std::array<cv::Mat, 3> of_left, of_right;
  cv::split(left, of_left);
  cv::split(right, of_right);
  const double variance = of_left[0].dot(of_left[0]) / static_cast<double>(light.total());
  const double largest = kSensorSigmas * variance * std::sqrt(static_cast<double>(light.total()));
  EXPECT_LE(std::abs(of_left[0].dot(of_left[1])), largest);
  EXPECT_LE(std::abs(of_left[0].dot(of_left[2])), largest);
  EXPECT_LE(std::abs(of_left[1].dot(of_right[1])), largest);
  const cv::Mat shifted = of_left[0].colRange(1, 1024).clone();
  EXPECT_LE(std::abs(of_left[0].colRange(0, 1023).clone().dot(shifted)), largest);
}

TEST(Develop, BalancesWhiteInTheOrderRedGreenBlue) {
  const CameraSensor sensor{.white_balance_rgb = {1.2, 1.0, 0.8}};
  EXPECT_EQ(develop(grey_picture({4, 4}, 100), sensor, 0, 0).at<cv::Vec3b>(2, 2), cv::Vec3b(80, 100, 120));
}

TEST(Develop, VignetteTakesTheSquareOfTheRadius) {
  const cv::Mat picture = develop(grey_picture({101, 81}, 200), {.vignette = 0.4}, 0, 0);
  EXPECT_EQ(picture.at<cv::Vec3b>(40, 50)[0], 200);
  EXPECT_EQ(picture.at<cv::Vec3b>(0, 0)[1], 120);
  EXPECT_EQ(picture.at<cv::Vec3b>(80, 100)[2], 120);
  EXPECT_EQ(picture.at<cv::Vec3b>(20, 25)[0], 180);  // half way out
}

TEST(Develop, EncodesAsTheStandardSays) {
  const auto stored = [](Encoding encoding, double gamma, int light) {
    const CameraSensor sensor{.encoding = encoding, .gamma = gamma};
    return static_cast<int>(develop(grey_picture({1, 1}, light), sensor, 0, 0).at<cv::Vec3b>(0, 0)[0]);
  };
  EXPECT_EQ(stored(Encoding::kSrgb, 2.2, 0), 0);
  EXPECT_EQ(stored(Encoding::kSrgb, 2.2, 255), 255);
  EXPECT_EQ(stored(Encoding::kSrgb, 2.2, 128), 188);  // the well-known middle grey
  EXPECT_EQ(stored(Encoding::kSrgb, 2.2, 55), 128);
  EXPECT_EQ(stored(Encoding::kSrgb, 2.2, 1), 13);
  EXPECT_EQ(stored(Encoding::kSrgb, 2.2, 10), 56);  // the straight part has ended
  EXPECT_EQ(stored(Encoding::kGamma, 2.0, 64), 128);
  EXPECT_EQ(stored(Encoding::kGamma, 1.0, 77), 77);
}

// Bright levels of sRGB are two apart. Mutation: the decoder of the other encoding.
TEST(Develop, IsDecodedToTheLightThatWasSeen) {
  cv::Mat light(1, 256, CV_8UC3);
  for (int i = 0; i < 256; ++i) light.at<cv::Vec3b>(0, i) = cv::Vec3b::all(static_cast<std::uint8_t>(i));
  for (const Encoding encoding : {Encoding::kLinear, Encoding::kSrgb, Encoding::kGamma}) {
    const CameraSensor sensor{.encoding = encoding, .gamma = 1.8};
    EXPECT_LE(cv::norm(decode(develop(light, sensor, 0, 0), sensor), light, cv::NORM_INF), 1.0);
  }
}

// A point of light keeps its light and becomes a Gaussian of the size asked for. It is bright and the gain
// makes its faint skirts visible.
// Mutations: samples of the Gaussian for weights make 0.46 of 0.5, and 0.09 of 0.3.
TEST(Develop, DefocusSpreadsAPointToTheSizeAskedFor) {
  for (const double sd : {0.2, 0.3, 0.5, 0.8, 1.5, 3.0}) {
    cv::Mat light(81, 81, CV_8UC3, cv::Scalar::all(0));
    const double gain = std::max(0.9, 2.0 * M_PI * sd * sd * 0.7);  // the peak stays below white
    light.at<cv::Vec3b>(40, 40) = cv::Vec3b(255, 255, 255);
    const cv::Mat picture = develop(light, {.defocus_sd_px = sd, .gain = gain}, 0, 0);
    double sum = 0.0, second = 0.0;
    for (int y = 0; y < 81; ++y) {
      for (int x = 0; x < 81; ++x) {
        const double level = picture.at<cv::Vec3b>(y, x)[0];
        sum += level;
        second += level * (x - 40) * (x - 40);
      }
    }
    EXPECT_NEAR(sum / (255.0 * gain), 1.0, 0.02) << sd;
    EXPECT_NEAR(std::sqrt(second / sum), sd, 0.03 * sd + 0.015) << sd;  // whole levels
  }
}

TEST(Develop, DefocusLeavesEvenLightAlone) {
  const cv::Mat picture = develop(grey_picture({40, 30}, 77), {.defocus_sd_px = 4.0}, 0, 0);
  EXPECT_EQ(cv::countNonZero(picture.reshape(1) != 77), 0);
}

// The two ways to add noise of one size draw the same numbers and differ by their rounding.
TEST(Develop, AddsTheNoiseThatExposeAddsFast) {
  const cv::Mat light = grey_picture({64, 48}, 120);
  const CameraSensor sensor{.noise_sd_levels = 3.0};
  const cv::Mat fast = expose({{light, {}, {}}, {light, {}, {}}}, sensor, 5, 17).right;
  EXPECT_LE(cv::norm(fast, develop(light, sensor, 5, 35), cv::NORM_INF), 1.0);
}

TEST(Develop, ClampsAtBlackAndWhite) {
  const CameraSensor sensor{.full_well_electrons = 300.0, .read_noise_electrons = 200.0, .gain = 50.0};
  const cv::Mat picture = develop(grey_picture({64, 48}, 128), sensor, 0, 0);
  EXPECT_GT(cv::countNonZero(picture.reshape(1) == 0), 0);
  EXPECT_GT(cv::countNonZero(picture.reshape(1) == 255), 0);
}

TEST(Develop, ExposeRefusesWhatMeansNothing) {
  const cv::Mat light = grey_picture({8, 8}, 120);
  const auto refused = [&](const CameraSensor& sensor) {
    EXPECT_THROW(expose({{light, {}, {}}, {light, {}, {}}}, sensor, 0, 0), std::invalid_argument);
  };
  refused({.defocus_sd_px = -1.0});
  refused({.vignette = 1.5});
  refused({.exposure = NAN});
  refused({.full_well_electrons = -1.0});
  refused({.read_noise_electrons = INFINITY});
  refused({.gain = -1.0});
  refused({.white_balance_rgb = {1.0, NAN, 1.0}});
  refused({.encoding = Encoding::kGamma, .gamma = 0.0});
}

}  // namespace
}  // namespace stereobench::renderer
