#include "slam/math/elementary.h"

#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "slam/math/angles.h"
#include "slam/math/random.h"

namespace stereobench::slam {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kUlp = std::numeric_limits<double>::epsilon();

/// Numbers of all sizes, both signs.
double any_number(RandomStream& random) {
  return random.normal() * std::exp2(40.0 * (random.uniform() - 0.5));
}

::testing::AssertionResult close(double value, double reference, double ulps) {
  if (std::abs(value - reference) <= ulps * kUlp * std::abs(reference)) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << value << " is not " << reference;
}

// The C library is the reference: within one unit in the last place of the truth itself.
TEST(Elementary, FunctionsAreThoseOfTheCLibrary) {
  RandomStream random(0, Stream::kWorld);
  for (int i = 0; i < 10000; ++i) {
    const double x = any_number(random);
    const double y = any_number(random);
    const auto [s, c] = sine_cosine(x);
    EXPECT_TRUE(close(s, std::sin(x), 4.5)) << x;
    EXPECT_TRUE(close(c, std::cos(x), 4.5)) << x;
    EXPECT_TRUE(close(tangent(x), std::tan(x), 4.5)) << x;
    EXPECT_TRUE(close(arc_tangent(y, x), std::atan2(y, x), 4.5)) << y << ", " << x;
    EXPECT_TRUE(close(logarithm(std::abs(x)), std::log(std::abs(x)), 4.5)) << x;
    EXPECT_TRUE(close(power(std::abs(x), 1.0 / 2.2), std::pow(std::abs(x), 1.0 / 2.2), 2.0)) << x;
    EXPECT_TRUE(close(logarithm_of_one_plus(std::abs(x)), std::log1p(std::abs(x)), 2.0)) << x;
  }
}

// Two at a time are each by itself, to the last bit, wherever they stand and whatever is beside them.
TEST(Elementary, TwoArcTangentsAreEachByItself) {
  RandomStream random(2, Stream::kWorld);
  const std::array<double, 6> odd = {0.0, -0.0, 1e-310, -1e300, kInfinity, -kInfinity};
  const auto any = [&] { return random.uniform() < 0.2 ? odd[random.bits() % 6] : any_number(random); };
  for (int i = 0; i < 100000; ++i) {
    const std::array<double, 2> y = {any(), any()}, x = {any(), any()};
    const std::array<double, 2> both = arc_tangents(y, x);
    for (std::size_t k = 0; k < 2; ++k) {
      ASSERT_EQ(both[k], arc_tangent(y[k], x[k])) << y[k] << ", " << x[k];
      ASSERT_EQ(std::signbit(both[k]), std::signbit(arc_tangent(y[k], x[k]))) << y[k] << ", " << x[k];
    }
  }
}

TEST(Elementary, ExponentialUndoesTheLogarithm) {
  RandomStream random(1, Stream::kWorld);
  for (int i = 0; i < 10000; ++i) {
    const double x = 100.0 * random.normal();
    EXPECT_TRUE(close(exponential(x), std::exp(x), 2.0)) << x;
    EXPECT_TRUE(close(complementary_error(0.05 * x), std::erfc(0.05 * x), 4.0)) << 0.05 * x;
    EXPECT_NEAR(logarithm(exponential(x)), x, 1e-13 * (1.0 + std::abs(x)));
  }
}

// What the filters lean on: four quadrants, both axes, the robot's own place, weights that vanished.
TEST(Elementary, EdgesAreThoseOfTheCLibrary) {
  EXPECT_EQ(sine_cosine(0.0).sine, 0.0);
  EXPECT_EQ(sine_cosine(0.0).cosine, 1.0);
  for (const double y : {-2.0, -0.0, 0.0, 2.0}) {
    for (const double x : {-3.0, 0.0, 3.0})
      EXPECT_TRUE(close(arc_tangent(y, x), std::atan2(y, x), 4.5)) << y << x;
  }
  EXPECT_EQ(arc_tangent(0.0, 0.0), 0.0);
  EXPECT_EQ(arc_tangent(0.0, -1.0), kPi);
  EXPECT_EQ(exponential(-kInfinity), 0.0);
  EXPECT_EQ(exponential(-800.0), 0.0);
  EXPECT_EQ(logarithm(1.0), 0.0);
  EXPECT_EQ(logarithm(0.0), -kInfinity);
  EXPECT_EQ(logarithm_of_one_plus(-1.0), -kInfinity);
  EXPECT_TRUE(std::isnan(logarithm(-1.0)));
  EXPECT_TRUE(std::isnan(sine_cosine(kInfinity).sine));
  EXPECT_TRUE(std::isnan(sine_cosine(std::nan("")).cosine));
}

}  // namespace
}  // namespace stereobench::slam
