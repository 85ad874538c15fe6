#include "vision/outline/edge.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/vision/painter.h"
#include "vision/observe.h"
#include "vision/outline/edge_profile.h"

namespace stereobench::vision {
namespace {

// A half plane's share of the unit square around a pixel, counted on a fine grid.
double counted_share(const RimPoint& rim) {
  constexpr int kGrid = 200;
  int inside = 0;
  for (int j = 0; j < kGrid; ++j) {
    for (int i = 0; i < kGrid; ++i) {
      const Eigen::Vector2d p((i + 0.5) / kGrid - 0.5, (j + 0.5) / kGrid - 0.5);
      if (p.dot(rim.normal) + rim.distance_px < 0.0) ++inside;
    }
  }
  return static_cast<double>(inside) / (kGrid * kGrid);
}

TEST(EdgeCoverage, IsTheShareOfThePixelInsideTheEdge) {
  painter::Dice dice(1);
  for (int i = 0; i < 300; ++i) {
    const double angle = dice.uniform(0.0, 6.2832);
    const RimPoint rim{dice.uniform(-0.9, 0.9), {std::cos(angle), std::sin(angle)}};
    ASSERT_NEAR(edge_coverage(rim).fraction, counted_share(rim), 0.006) << rim.distance_px << " at " << angle;
  }
}

template <typename CoverageAt>
void expect_derivative(CoverageAt coverage, const RimPoint& rim) {
  const double step = 1e-6;
  const double inner = coverage({rim.distance_px - step, rim.normal}).fraction;
  const double outer = coverage({rim.distance_px + step, rim.normal}).fraction;
  ASSERT_NEAR(coverage(rim).per_px, (inner - outer) / (2.0 * step), 1e-4);
}

TEST(EdgeCoverage, DerivativesAreThoseOfTheCoverage) {
  painter::Dice dice(2);
  for (int i = 0; i < 300; ++i) {
    const double angle = dice.uniform(0.0, 6.2832);
    const RimPoint rim{dice.uniform(-2.4, 2.4), {std::cos(angle), std::sin(angle)}};
    expect_derivative([](const RimPoint& r) { return edge_coverage(r); }, rim);
    expect_derivative([](const RimPoint& r) { return ramp_coverage(r, 2.0); }, rim);
  }
}

double gaussian(double x, double sd) {
  return std::exp(-0.5 * x * x / (sd * sd)) / (sd * std::sqrt(2.0 * M_PI));
}

// The box's coverage under a Gaussian, summed over small steps.
double blurred_box(const RimPoint& rim, double blur_px) {
  constexpr double kStep = 0.01;
  double sum = 0.0;
  for (double shift = -6.0 * blur_px; shift <= 6.0 * blur_px; shift += kStep)
    sum += gaussian(shift, blur_px) * edge_coverage({rim.distance_px + shift, rim.normal}).fraction;
  return sum * kStep;
}

TEST(BlurredCoverage, IsNearlyTheBoxUnderAGaussian) {
  painter::Dice dice(3);
  for (int i = 0; i < 400; ++i) {
    const double angle = dice.uniform(0.0, 6.2832);
    const double blur = dice.uniform(0.3, 2.0);
    const RimPoint rim{dice.uniform(-3.0, 3.0), {std::cos(angle), std::sin(angle)}};
    ASSERT_NEAR(blurred_coverage(rim.distance_px, blur).fraction, blurred_box(rim, blur), 0.008)
        << rim.distance_px << " at " << angle << " blurred by " << blur;
  }
}

TEST(BlurredCoverage, DerivativesAreThoseOfTheCoverage) {
  painter::Dice dice(4);
  for (int i = 0; i < 300; ++i) {
    const double blur = dice.uniform(0.3, 2.0);
    const RimPoint rim{dice.uniform(-3.0, 3.0), {1.0, 0.0}};
    expect_derivative([&](const RimPoint& r) { return blurred_coverage(r.distance_px, blur); }, rim);
    const double step = 1e-6;
    const double more = blurred_coverage(rim.distance_px, std::sqrt(blur * blur + step)).fraction;
    const double less = blurred_coverage(rim.distance_px, std::sqrt(blur * blur - step)).fraction;
    ASSERT_NEAR(coverage_per_blur2(rim.distance_px, blur), (more - less) / (2.0 * step), 1e-6);
  }
}

// The places inside of the edge whose light a pixel gathers have the mean of the two depths, and their
// deviation.
TEST(CoveredDepths, HaveTheMeanAndTheSpreadOfThePlacesThatAreSeen) {
  painter::Dice dice(5);
  for (int i = 0; i < 100; ++i) {
    const double blur = dice.uniform(0.3, 2.0);
    const double distance = dice.uniform(-3.0, 3.0) * blur;
    const double spread = std::hypot(blur, std::sqrt(1.0 / 12.0));
    double weight = 0.0, first = 0.0, second = 0.0;
    const double step = 1e-3 * spread;
    for (double depth = std::max(distance, -8.0 * spread) + 0.5 * step; depth < 8.0 * spread; depth += step) {
      const double seen = gaussian(depth, spread);
      weight += seen;
      first += seen * depth;
      second += seen * depth * depth;
    }
    const double mean = first / weight;
    const double deviation = std::sqrt(second / weight - mean * mean);
    const auto [near, deep] = covered_depths_px(distance, blur);
    ASSERT_NEAR(0.5 * (near + deep), mean, 2e-3 * spread) << distance << " blurred by " << blur;
    ASSERT_NEAR(0.5 * (deep - near), deviation, 2e-3 * spread) << distance << " blurred by " << blur;
    ASSERT_GE(near, distance - 1e-9);  // inside of the edge
  }
}

TEST(EdgeWidth, IsTheInverseOfTheSlopesOwnMean) {
  for (const double blur : {0.3, 1.0, 2.5}) {
    double squares = 0.0;
    for (double x = -12.0; x < 12.0; x += 0.01)
      squares += std::pow(blurred_coverage(x, blur).per_px, 2) * 0.01;
    EXPECT_NEAR(edge_width_px(blur), 1.0 / squares, 1e-4);
  }
  EXPECT_EQ(edge_width_px(0.0), 1.0);
}

// What pixels at random distances show of an edge that is blurred, with some noise.
EdgeProfile profile_of(double blur_px, std::uint64_t seed, int pixels = 1000) {
  painter::Dice dice(seed);
  EdgeProfile profile;
  for (int i = 0; i < pixels; ++i) {
    const double angle = dice.uniform(0.0, 6.2832);
    const RimPoint rim{dice.uniform(-4.0, 4.0), {std::cos(angle), std::sin(angle)}};
    const double share = blur_px > 0.0 ? blurred_box(rim, blur_px) : edge_coverage(rim).fraction;
    const double whole = dice.uniform(0.7, 1.1);  // shades
    profile.add(rim.distance_px, whole * share + 0.01 * dice.normal(), whole, 1e4);
  }
  return profile;
}

// The slope of the fit to 1,000 pixels leaves 0.005 px; the bins and the box that is not a Gaussian 0.015.
TEST(EdgeProfile, TellsTheBlur) {
  for (const double blur : {0.3, 0.5, 0.8, 1.2, 2.0})
    EXPECT_NEAR(profile_of(blur, 6).blur_px(), blur, 0.03 + 0.01 * blur) << blur;
}

TEST(EdgeProfile, OfAPictureInFocusTellsLessBlurThanAnyLensMakes) {
  for (const std::uint64_t seed : {7U, 8U, 9U}) EXPECT_LT(profile_of(0.0, seed).blur_px(), 0.15);
  EXPECT_EQ(EdgeProfile().blur_px(), 0.0);
}

// Rims as they are looked at: from colours beside them that are measured too, and first as if in focus.
// Mutation: outlines measured once.
TEST(EdgeProfile, OfAPictureTellsItsBlur) {
  const StereoRig rig = painter::rig_with_pictures_of(640, 480);
  for (const double blur : {0.4, 0.8, 1.3}) {
    painter::Scene scene{.backdrop = painter::Backdrop::kPlain, .blur_px = blur, .noise_sd_levels = 2.0};
    scene.balls = painter::scattered_balls(rig, 1.0, 4.0, 31);
    EdgeProfile edge;
    for (const MeasuredOutline& outline :
         find_outlines(painter::paint(scene, rig).left, rig.intrinsics, {.noise_sd_levels = 2.0}))
      edge.add(outline.edge);
    EXPECT_NEAR(edge.blur_px(), blur, 0.06) << blur;
  }
}

TEST(EdgeProfile, IsThatOfAllPixelsOfTwo) {
  EdgeProfile both = profile_of(1.0, 10, 200);
  both.add(profile_of(2.0, 11, 200));
  EXPECT_GT(both.blur_px(), profile_of(1.0, 10, 200).blur_px() + 0.1);
  EXPECT_LT(both.blur_px(), profile_of(2.0, 11, 200).blur_px() - 0.1);
}

}  // namespace
}  // namespace stereobench::vision
