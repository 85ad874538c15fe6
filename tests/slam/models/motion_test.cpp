#include "slam/models/motion.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/slam/checks.h"

namespace stereobench::slam {
namespace {

Pose any_pose(RandomStream& random) {
  return {10.0 * random.normal(), 10.0 * random.normal(), wrap_angle(3.0 * random.normal())};
}

Control any_control(RandomStream& random) {
  return {2.0 * random.normal(), 2.0 * random.normal(), 2.0 * random.uniform()};
}

class MotionLaws : public ::testing::TestWithParam<int> {
 protected:
  RandomStream random_{static_cast<std::uint64_t>(GetParam()), Stream::kWorld};
};
INSTANTIATE_TEST_SUITE_P(Motion, MotionLaws, ::testing::Range(0, 50));

// Exact only for the true arc: catches the chord taken along the old heading, an Euler
// step, and a threshold that jumps.
TEST_P(MotionLaws, HalfAStepPlusHalfAStepIsAStep) {
  const Pose start = any_pose(random_);
  const Control whole = any_control(random_);
  Control half = whole;
  half.duration_s *= 0.5;
  EXPECT_TRUE(near(advance(advance(start, half), half), advance(start, whole), 1e-12));
}

// Eq. 4 as printed, where it can be evaluated. Catches a sign or a sine in place of a cosine.
TEST_P(MotionLaws, AdvanceIsEquation4WhereThatIsDefined) {
  const Pose p = any_pose(random_);
  const Control u = any_control(random_);
  const double radius = u.v_mps / u.w_radps;
  const double end = p.heading_rad + u.w_radps * u.duration_s;
  const Pose printed = {p.x_m - radius * std::sin(p.heading_rad) + radius * std::sin(end),
                        p.y_m + radius * std::cos(p.heading_rad) - radius * std::cos(end), wrap_angle(end)};
  EXPECT_TRUE(near(advance(p, u), printed, 1e-10));
}

// Errata: eq. 4 divides by w. Catches that division.
TEST_P(MotionLaws, AdvanceIsSmoothThroughNoTurnAtAll) {
  const Pose start = any_pose(random_);
  const double v = random_.normal();
  const Pose straight = advance(start, {v, 0.0, 1.0});
  const Pose expected = {start.x_m + v * std::cos(start.heading_rad),
                         start.y_m + v * std::sin(start.heading_rad), start.heading_rad};
  EXPECT_TRUE(near(straight, expected, 1e-14));
  for (const double w : {1e-300, 1e-12, 1e-8, 1.9e-4, 2.1e-4}) {
    EXPECT_TRUE(near(advance(start, {v, w, 1.0}), straight, 3.0 * w * (1.0 + std::abs(v)) + 1e-14)) << w;
  }
}

// What the filters' shared motion rests on: a control does the same wherever it is given.
TEST_P(MotionLaws, MotionDoesNotDependOnWhereItHappens) {
  const Pose start = any_pose(random_);
  const Control control = any_control(random_);
  EXPECT_TRUE(near(advance(start, control), compose(start, advance(Pose{}, control)), 1e-12));
}

TEST_P(MotionLaws, PosesFormAGroup) {
  const Pose a = any_pose(random_);
  const Pose b = any_pose(random_);
  const Pose c = any_pose(random_);
  EXPECT_TRUE(near(compose(a, inverse(a)), Pose{}, 1e-12));
  EXPECT_TRUE(near(compose(inverse(a), a), Pose{}, 1e-12));
  EXPECT_TRUE(near(compose(compose(a, b), c), compose(a, compose(b, c)), 1e-11));
}

TEST_P(MotionLaws, WrappedAngleIsTheSameDirectionWithinHalfATurn) {
  const double angle = 1000.0 * random_.normal();
  const double wrapped = wrap_angle(angle);
  EXPECT_TRUE(wrapped > -M_PI && wrapped <= M_PI);
  EXPECT_NEAR(std::cos(wrapped), std::cos(angle), 1e-12);
  EXPECT_NEAR(std::sin(wrapped), std::sin(angle), 1e-12);
}

TEST(WrapAngle, KeepsPiAndTurnsMinusPi) {
  EXPECT_EQ(wrap_angle(M_PI), M_PI);
  EXPECT_EQ(wrap_angle(-M_PI), M_PI);
  EXPECT_TRUE(std::isnan(wrap_angle(std::numeric_limits<double>::quiet_NaN())));
}

// Errata: eq. 3 does not say whether it means deviations or variances. Catches squaring.
TEST(StandardDeviations, AreSumsOfTheirPartsAndDoNotCareForSigns) {
  const OdometryNoise noise{0.01, 0.1, 0.2, 0.03, 0.3, 0.4};
  const Eigen::Vector2d expected(0.01 + 0.1 * 2.0 + 0.2 * 3.0, 0.03 + 0.3 * 2.0 + 0.4 * 3.0);
  EXPECT_TRUE(near(standard_deviations({-2.0, 3.0, 1.0}, noise), expected, 1e-15));
  EXPECT_TRUE(near(standard_deviations({2.0, -3.0, 1.0}, noise), expected, 1e-15));
}

// A path spreads the same however finely its odometry is divided, as long as the parts are shorter than an
// error lasts. Catches a correlation time that is not read, one without the root, and one that shrinks the
// errors of long controls.
TEST(StandardDeviations, SpreadAPathTheSameHoweverFinelyItIsDivided) {
  OdometryNoise noise{0.01, 0.1, 0.2, 0.03, 0.3, 0.4};
  const Eigen::Vector2d of_one_control = standard_deviations({2.0, 3.0, 1.0}, noise);
  noise.correlation_s = 1.0;
  for (const double parts : {1.0, 2.0, 10.0, 500.0}) {
    const Eigen::Vector2d sd = standard_deviations({2.0, 3.0, 1.0 / parts}, noise);
    EXPECT_TRUE(near(std::sqrt(parts) * (sd / parts), of_one_control, 1e-12)) << parts;
  }
  for (const double duration_s : {0.0, 1.0, 60.0}) {
    EXPECT_TRUE(near(standard_deviations({2.0, 3.0, duration_s}, noise), of_one_control, 0.0)) << duration_s;
  }
}

// Five standard errors. Catches variances used as deviations and one normal used twice.
TEST(Perturb, HasTheDeviationsItWasAskedFor) {
  const OdometryNoise noise{0.2, 0.0, 0.0, 0.05, 0.0, 0.0};
  RandomStream random(3, Stream::kOdometry);
  constexpr int kDraws = 50000;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  for (int i = 0; i < kDraws; ++i) {
    const Control drawn = perturb({1.0, 2.0, 0.5}, noise, random);
    const Eigen::Vector2d off(drawn.v_mps - 1.0, drawn.w_radps - 2.0);
    covariance += off * off.transpose() / kDraws;
    ASSERT_EQ(drawn.duration_s, 0.5);
  }
  EXPECT_NEAR(covariance(0, 0) / 0.04, 1.0, 5.0 * std::sqrt(2.0 / kDraws));
  EXPECT_NEAR(covariance(1, 1) / 0.0025, 1.0, 5.0 * std::sqrt(2.0 / kDraws));
  EXPECT_NEAR(covariance(0, 1) / 0.01, 0.0, 5.0 * std::sqrt(1.0 / kDraws));
}

TEST(IsValid, RefusesControlsThatAreNotFiniteOrRunBackwards) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(is_valid(Control{1.0, 0.0, 0.0}));
  EXPECT_FALSE(is_valid(Control{nan, 0.0, 1.0}));
  EXPECT_FALSE(is_valid(Control{1.0, nan, 1.0}));
  EXPECT_FALSE(is_valid(Control{1.0, 0.0, -1.0}));
  EXPECT_FALSE(is_valid(Control{1.0, 0.0, std::numeric_limits<double>::infinity()}));
}

}  // namespace
}  // namespace stereobench::slam
