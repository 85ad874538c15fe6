// Balls of which two outlines and a size are told, with errors that are as large as said: what becomes of
// them.
#include "vision/stereo/ball_fit.h"

#include <cmath>
#include <numbers>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "slam/math/random.h"
#include "vision/camera/rig.h"
#include "vision/stereo/sphere.h"

namespace stereobench::vision {
namespace {

constexpr double kBallRadius_m = 0.06;
constexpr int kBalls = 4000;

/// A ball somewhere in view of both cameras, and what they measure of it.
struct Drawn {
  SizedBall ball;
  MeasuredOutline left, right;
};

/// Errors of a disc with the same contrast all around: those of a radius have half the variance of a
/// column's.
MeasuredOutline measure(const Intrinsics& camera, const SizedBall& ball, slam::RandomStream& random) {
  const Eigen::Vector3d outline = seen_outline(camera, ball).outline_px;
  const double variance = 0.0005 / outline.z();
  const Eigen::Vector3d variances(variance, variance, 0.5 * variance);
  const Eigen::Vector3d errors(random.normal(), random.normal(), random.normal());
  const Eigen::Vector3d seen = outline + variances.cwiseSqrt().cwiseProduct(errors);
  MeasuredOutline measured;
  measured.centre_px = seen.head<2>();
  measured.radius_px = seen.z();
  measured.covariance_px2 = variances.asDiagonal();
  return measured;
}

Drawn draw(const StereoRig& rig, double radius_sd_m, std::uint64_t seed) {
  slam::RandomStream random(seed, slam::Stream::kWorld);
  const double depth_m = 0.6 + 6.0 * random.uniform();
  const Eigen::Vector2d aside(random.uniform() - 0.5, 0.6 * random.uniform() - 0.3);
  Drawn drawn;
  drawn.ball << aside * depth_m, depth_m, kBallRadius_m + radius_sd_m * random.normal();
  drawn.left = measure(rig.intrinsics, drawn.ball, random);
  drawn.right = measure(rig.intrinsics, drawn.ball - SizedBall(rig.baseline_m, 0.0, 0.0, 0.0), random);
  return drawn;
}

/// Mean squares over many balls: of depth errors in units of what centres alone would give, and of errors in
/// units of what is stated.
struct Errors {
  double relative2 = 0.0;
  double nis3 = 0.0;
};

double disparity_variance_m2(const Drawn& drawn) {
  const double disparity = drawn.left.centre_px.x() - drawn.right.centre_px.x();
  const double by_pixel = drawn.ball.z() / disparity;
  return by_pixel * by_pixel * (drawn.left.covariance_px2(0, 0) + drawn.right.covariance_px2(0, 0));
}

Errors errors_with(double radius_sd_m, double told_sd_m) {
  const StereoRig rig;
  Errors errors;
  for (int i = 0; i < kBalls; ++i) {
    const Drawn drawn = draw(rig, radius_sd_m, static_cast<std::uint64_t>(i));
    const auto loose = fit_ball(rig, drawn.left, drawn.right, kBallRadius_m);
    EXPECT_TRUE(loose);
    const BallFit fit = fit_ball_of_size(rig, drawn.left, drawn.right, {kBallRadius_m, told_sd_m}, *loose);
    const Eigen::Vector3d error = fit.ball_in_camera - drawn.ball.head<3>();
    errors.relative2 += error.z() * error.z() / disparity_variance_m2(drawn) / kBalls;
    errors.nis3 += error.dot(fit.covariance_m2.inverse() * error) / 3.0 / kBalls;
  }
  return errors;
}

constexpr double kOfMean =
    4.0 * std::numbers::sqrt2 / 63.2;  // four standard errors of a mean of 4000 squares

// A known size has 8 R^2 / B^2 times the information of the disparity, so that the error is 1.73 times
// smaller. Mutations: the size held to a tenth, as before it could be told (the ratio is 1); the cameras'
// radii left out.
TEST(BallOfSize, ExactlyKnownIsMeasuredByItsSizeAsWell) {
  const double ratio =
      8.0 * kBallRadius_m * kBallRadius_m / (StereoRig{}.baseline_m * StereoRig{}.baseline_m);
  const Errors errors = errors_with(0.0, 0.0);
  EXPECT_NEAR(errors.relative2 * (1.0 + ratio), 1.0, kOfMean + 0.02);
  EXPECT_NEAR(errors.nis3, 1.0, kOfMean);
}

// A size that is known to 0.02 mm leaves 0.71 of the squares. Mutations: the tolerance's square root, or half
// of it, in the covariance.
TEST(BallOfSize, CountsItsSizeByItsTolerance) {
  double before = 0.0;
  for (const double sd_m : {0.0, 2e-5, 1e-4, 1e-3}) {
    const Errors errors = errors_with(sd_m, sd_m);
    EXPECT_NEAR(errors.nis3, 1.0, kOfMean) << sd_m;
    EXPECT_GT(errors.relative2, before) << sd_m;
    EXPECT_LT(errors.relative2, sd_m <= 2e-5 ? 0.71 + kOfMean : 1.0 + kOfMean) << sd_m;
    before = errors.relative2;
  }
  EXPECT_GT(before, 1.0 - kOfMean);  // a millimetre more or less tells nothing: it is what centres give
}

// Law: the covariance, too, goes from that of a known size to that of the loose fit, and to nothing else.
TEST(BallOfSize, OfATenthMoreOrLessIsTheLooseFit) {
  const StereoRig rig;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const Drawn drawn = draw(rig, 0.0, seed);
    const BallFit loose = fit_ball(rig, drawn.left, drawn.right, kBallRadius_m).value();
    const BallFit fit =
        fit_ball_of_size(rig, drawn.left, drawn.right, {kBallRadius_m, 0.1 * kBallRadius_m}, loose);
    EXPECT_LT((fit.ball_in_camera - loose.ball_in_camera).norm(), 1e-9);
    EXPECT_LT((fit.covariance_m2 - loose.covariance_m2).norm(), 1e-6 * loose.covariance_m2.norm());
  }
}

// A ball that is two percent larger than told: either its size or the rig is wrong, so that it stands half
// way between, a percent off, with sqrt(2) percent claimed. Mutation: the size, or the disparity, believed
// all the same (NIS of some 1000).
TEST(BallOfSize, ThatContradictsItsDisparityClaimsSo) {
  const StereoRig rig;
  double squares = 0.0;
  for (int i = 0; i < 400; ++i) {
    const Drawn drawn = draw(rig, 0.0, static_cast<std::uint64_t>(i));
    const double told_m = kBallRadius_m / 1.02;
    const BallFit loose = fit_ball(rig, drawn.left, drawn.right, told_m).value();
    const BallFit fit = fit_ball_of_size(rig, drawn.left, drawn.right, {told_m, 0.0}, loose);
    const double error_m = fit.ball_in_camera.z() - drawn.ball.z();
    squares += error_m * error_m / fit.covariance_m2(2, 2) / 400.0;
  }
  EXPECT_NEAR(squares, 0.5, 0.1);
}

// Law: where a right camera is turned by so much that disparities tell nothing, the size does. The camera
// sees an outline that is moved and stretched: a turn of half a degree that stretched nothing would be a
// disparity off by a third. Mutation: the stretch left out of the covariance (345 of 400 balls fail, by 9 to
// 57 %).
TEST(BallThroughATurnedCamera, IsWhereItsSizeSays) {
  const StereoRig rig;
  StereoRig turned = rig;
  turned.right_turn_rad.y() = 0.5 * std::numbers::pi / 180.0;
  const double sd_px = 0.0105 * rig.intrinsics.focal_px;
  for (int i = 0; i < 400; ++i) {
    Drawn drawn = draw(rig, 0.0, static_cast<std::uint64_t>(i));
    SizedBall in_right;
    in_right << camera_point(turned, drawn.ball.head<3>(), Side::kRight), kBallRadius_m;
    const Eigen::Vector3d seen = seen_outline(rig.intrinsics, in_right).outline_px;
    drawn.right.centre_px = {seen.x(), drawn.left.centre_px.y()};  // rows tell of other turns
    drawn.right.radius_px = seen.z();
    const auto fit = fit_ball(rig, drawn.left, drawn.right, kBallRadius_m, sd_px * sd_px);
    ASSERT_TRUE(fit) << i;
    EXPECT_NEAR(fit->ball_in_camera.z() / drawn.ball.z(), 1.0, 0.08) << i;
  }
}

}  // namespace
}  // namespace stereobench::vision
