#include "harness/detector_noise/serialise.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace stereobench::harness {
namespace {

// Mutation: leaving out what was measured in pixels.
TEST(SerialiseTake, CarriesWhatACalibrationSceneGave) {
  CalibrationTake take;
  take.samples = {{.truth = {3.0, 0.1}, .depth_m = 2.5, .whole = false}};
  take.samples[0].disparity_error_px = std::numeric_limits<double>::quiet_NaN();
  take.samples[0].radius_error_px = {0.1, -0.2};
  take.score.visible = 4;
  const CalibrationTake back = calibration_take_from_bytes(to_bytes(take));
  ASSERT_EQ(back.samples.size(), 1U);
  EXPECT_EQ(back.samples[0].truth.x(), 3.0);
  EXPECT_TRUE(std::isnan(back.samples[0].disparity_error_px));
  EXPECT_EQ(back.samples[0].radius_error_px, Eigen::Vector2d(0.1, -0.2));
  EXPECT_EQ(back.samples[0].depth_m, 2.5);
  EXPECT_FALSE(back.samples[0].whole);
  EXPECT_EQ(back.score.visible, 4);
}

}  // namespace
}  // namespace stereobench::harness
