// Noise laws fitted to samples whose law is known.
#include "harness/detector_noise/noise_fit.h"

#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "slam/math/random.h"

namespace stereobench::harness {
namespace {

struct Truth {
  double range_sd_m = 0.01;
  double range_sd_per_m2 = 0.002;
  double bearing_sd_rad = 1e-4;
  Eigen::Vector2d worse = {1.5, 0.8};  ///< than stated
  double outliers = 0.0;               ///< of all, ten times as far out
};

double range_sd_m(const Truth& truth, double range_m) {
  return std::hypot(truth.range_sd_m, truth.range_sd_per_m2 * range_m * range_m);
}

std::vector<CalibrationSample> samples_of(const Truth& truth, int count, std::uint64_t seed) {
  slam::RandomStream random(seed, slam::Stream::kWorld);
  std::vector<CalibrationSample> samples;
  for (int i = 0; i < count; ++i) {
    CalibrationSample sample;
    sample.depth_m = 0.5 * std::pow(20.0, random.uniform());
    sample.truth = {sample.depth_m, random.uniform() - 0.5};
    const Eigen::Vector2d sd(range_sd_m(truth, sample.depth_m), truth.bearing_sd_rad);
    const double far = random.uniform() < truth.outliers ? 10.0 : 1.0;
    sample.error = {far * sd.x() * random.normal(), far * sd.y() * random.normal()};
    sample.stated = sd.cwiseQuotient(truth.worse).cwiseAbs2().asDiagonal();
    samples.push_back(sample);
  }
  return samples;
}

// A standard deviation from n samples is known to 1 / sqrt(2 n); bounds of four times that. The law's
// constant part rests on the near samples alone. Mutations: range and bearing swapped; the scale of variances
// for that of deviations; a growth with r for r^2.
TEST(NoiseFit, FindsTheLawThatSamplesHave) {
  constexpr int kCount = 4000;
  const FittedNoise fitted = fit_noise(samples_of({}, kCount, 1));
  const double four_sigma = 4.0 / std::sqrt(2.0 * kCount);
  EXPECT_NEAR(fitted.stated_sd_scale.x() / 1.5, 1.0, four_sigma);
  EXPECT_NEAR(fitted.stated_sd_scale.y() / 0.8, 1.0, four_sigma);
  EXPECT_NEAR(fitted.stereo.range_sd_per_m2 / 0.002, 1.0, 2.0 * four_sigma);
  EXPECT_NEAR(fitted.stereo.range_sd_m / 0.01, 1.0, 2.0 * four_sigma);
  EXPECT_NEAR(fitted.stereo.bearing_sd_rad / 1e-4, 1.0, four_sigma);
}

// One in fifty is ten times as far out: they would make the scale 1.7 times as large.
TEST(NoiseFit, LeavesOutWhatFiltersRefuse) {
  const FittedNoise fitted = fit_noise(samples_of({.outliers = 0.02}, 4000, 2));
  EXPECT_NEAR(fitted.stated_sd_scale.x() / 1.5, 1.0, 0.08);
  EXPECT_NEAR(fitted.stereo.range_sd_per_m2 / 0.002, 1.0, 0.12);
  EXPECT_NEAR(fitted.stereo.bearing_sd_rad / 1e-4, 1.0, 0.08);
}

// NIS / 2 of n samples scatters by 1 / sqrt(n), and the deviation in a bin lies between the law's at its
// ends. Mutations: bins from the wrong end; samples of the bin at the other end.
TEST(NoiseFit, BinsOfConsistentNoiseHaveANisOfOne) {
  const FittedNoise fitted = fit_noise(samples_of({}, 4000, 3));
  const auto held_out = samples_of({}, 4000, 4);
  const auto bins = bin_samples(held_out, fitted, 0.5, 10.0, 4);
  ASSERT_EQ(bins.size(), 5U);
  for (int i = 0; i < 4; ++i) {
    const CalibrationBin& bin = bins[static_cast<std::size_t>(i)];
    const double four_sigma = 4.0 / std::sqrt(static_cast<double>(bin.samples));
    EXPECT_NEAR(static_cast<double>(bin.samples), 1000.0, 120.0);
    EXPECT_NEAR(bin.half_nis[0], (1.5 * 1.5 + 0.8 * 0.8) / 2.0, 2.0 * four_sigma);
    EXPECT_NEAR(bin.half_nis[1], 1.0, four_sigma);
    EXPECT_NEAR(bin.half_nis[2], 1.0, four_sigma + 0.05);
    EXPECT_NEAR(bin.correlation.x(), 0.0, four_sigma);
    EXPECT_GT(bin.sd.x(), range_sd_m({}, bin.nearest_m) * (1.0 - four_sigma));
    EXPECT_LT(bin.sd.x(), range_sd_m({}, bin.farthest_m) * (1.0 + four_sigma));
    EXPECT_LE(bin.refused, 3);
  }
  EXPECT_EQ(bins.back().samples, 0);
  EXPECT_TRUE(std::isnan(bins.back().half_nis[1]));
}

// What is ten times as far out is beyond the gate with 1 - 0.09. Mutation: refused ones counted.
TEST(NoiseFit, BinsLeaveOutWhatFiltersRefuse) {
  const FittedNoise fitted = fit_noise(samples_of({}, 4000, 5));
  const CalibrationBin bin =
      bin_samples(samples_of({.outliers = 0.02}, 4000, 6), fitted, 0.5, 10.0, 1).front();
  EXPECT_NEAR(static_cast<double>(bin.refused), 73.0, 4.0 * std::sqrt(73.0));
  EXPECT_NEAR(bin.half_nis[1], 1.0, 0.1);
}

// Samples of one distance that are all off by the same as well: what scatters is the deviation, what does not
// is the bias. Mutations: squares of the errors themselves, in sd, over_bound or the correlation.
TEST(NoiseFit, TheDeviationIsAboutTheBias) {
  const Eigen::Vector2d sd(0.02, 2e-4), bias(0.05, -6e-4);
  slam::RandomStream random(7, slam::Stream::kWorld);
  std::vector<CalibrationSample> samples;
  for (int i = 0; i < 2000; ++i) {
    CalibrationSample sample;
    sample.depth_m = 1.0;
    sample.truth = {1.0, 0.0};
    sample.error = bias + sd.cwiseProduct(Eigen::Vector2d(random.normal(), random.normal()));
    sample.stated = (4.0 * sd).cwiseAbs2().asDiagonal();
    sample.bounds.of_size = (0.5 * sd).cwiseAbs2().asDiagonal();
    sample.bounds.unknown_size = sd.cwiseAbs2().asDiagonal();
    samples.push_back(sample);
  }
  const CalibrationBin bin = bin_samples(samples, {}, 0.5, 10.0, 1).front();
  EXPECT_EQ(bin.refused, 0);
  for (int axis = 0; axis < 2; ++axis) {
    EXPECT_NEAR(bin.bias[axis], bias[axis], 4.0 * sd[axis] / std::sqrt(2000.0));
    EXPECT_NEAR(bin.sd[axis] / sd[axis], 1.0, 4.0 / std::sqrt(4000.0));
    EXPECT_NEAR(bin.over_bound[axis], 2.0, 8.0 / std::sqrt(4000.0));
    EXPECT_NEAR(bin.over_unknown_size[axis], 1.0, 4.0 / std::sqrt(4000.0));
  }
  EXPECT_NEAR(bin.correlation.x(), 0.0, 4.0 / std::sqrt(2000.0));
}

TEST(NoiseFit, OfNothingIsNothing) {
  const FittedNoise fitted = fit_noise({});
  EXPECT_EQ(fitted.stated_sd_scale, Eigen::Vector2d::Ones());
  EXPECT_EQ(fitted.stereo.range_sd_per_m2, 0.0);
}

}  // namespace
}  // namespace stereobench::harness
