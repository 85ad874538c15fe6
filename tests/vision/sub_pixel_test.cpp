// The S-curve: how the error of a centre goes with where it lies between the pixels.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/vision/s_curve.h"

namespace stereobench::vision {
namespace {

class SubPixel : public testing::TestWithParam<double> {};

// Eighteen colours without noise: what is left is the whole levels of their pixels, some 0.001 px a ball, and
// what the fit itself has wrong. Mutations: pixels taken whole; a pixel's corner taken for a whole strip of
// it.
TEST_P(SubPixel, TheSCurveIsFlat) {
  double lowest = 1.0, highest = -1.0;
  for (int phase = 0; phase < painter::kPhases; ++phase) {
    const painter::PhaseErrors errors = painter::errors_at_phase(phase, GetParam());
    EXPECT_EQ(errors.found, painter::kSCurveBalls);
    EXPECT_LT(std::abs(errors.left_px), 0.003) << "phase " << phase;
    EXPECT_LT(std::abs(errors.disparity_px), 0.003) << "phase " << phase;
    EXPECT_LT(errors.radius_px, 0.1) << "phase " << phase;
    lowest = std::min(lowest, errors.left_px);
    highest = std::max(highest, errors.left_px);
  }
  EXPECT_LT(highest - lowest, 0.003);
}
INSTANTIATE_TEST_SUITE_P(Radii, SubPixel, testing::Values(6.0, 12.0, 25.0));

}  // namespace
}  // namespace stereobench::vision
