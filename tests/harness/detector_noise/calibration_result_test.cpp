// Which calibration scenes the noise is fitted to, and which it is held against.
#include "harness/detector_noise/calibration_result.h"

#include <gtest/gtest.h>

namespace stereobench::harness {
namespace {

/// Errors that are all so many times as large as stated; parts of balls have errors of their own.
CalibrationTake take_of(double times, int whole, int parts) {
  CalibrationTake take;
  for (int i = 0; i < whole + parts; ++i) {
    CalibrationSample sample;
    sample.depth_m = 1.0;
    sample.truth = {1.0, 0.0};
    sample.whole = i < whole;
    const double sign = i % 2 == 0 ? 1.0 : -1.0;
    sample.error = sign * (sample.whole ? times : 3.0 * times) * Eigen::Vector2d(0.01, 0.001);
    sample.stated = Eigen::Vector2d(1e-4, 1e-6).asDiagonal();
    take.samples.push_back(sample);
  }
  return take;
}

// The errors of one half make the scale, those of the other are held against it.
// Mutations: either half's samples in the other as well; parts of balls in the fit.
TEST(CalibrationResult, IsOfScenesThatItWasNotFittedTo) {
  const std::vector<CalibrationTake> takes = {take_of(2.0, 20, 10), take_of(4.0, 30, 7), take_of(2.0, 20, 10),
                                              take_of(4.0, 40, 5)};
  const CalibrationResult result = calibrate(takes, {5, 6, 7, 8}, 0.5, 2.0);
  EXPECT_EQ(result.fitted_seeds, (std::vector<std::uint64_t>{5, 7}));
  EXPECT_EQ(result.held_out_seeds, (std::vector<std::uint64_t>{6, 8}));
  EXPECT_NEAR(result.noise.stated_sd_scale.x(), 2.0, 1e-12);
  EXPECT_NEAR(result.noise.stated_sd_scale.y(), 2.0, 1e-12);
  long whole = 0;
  for (const CalibrationBin& bin : result.bins) {
    if (!bin.whole || bin.samples == 0) continue;
    whole += bin.samples;
    EXPECT_NEAR(bin.half_nis[static_cast<int>(NoiseKind::kScaled)], 4.0, 1e-9);
  }
  EXPECT_EQ(whole, 70);
  EXPECT_EQ(result.bins.back().samples, 12);
}

}  // namespace
}  // namespace stereobench::harness
