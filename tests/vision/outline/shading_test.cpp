// The surface behind an outline, and the light source that a ball's shades tell of.
#include "vision/outline/shading.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/vision/painter.h"
#include "vision/stereo/sphere.h"

namespace stereobench::vision {
namespace {

constexpr double kRadius_m = 0.05;
const Eigen::Vector3d kPaint(40.0, 120.0, 220.0);

struct LitBall {
  Eigen::Vector3d in_camera;
  Eigen::Vector3d light_source;  // towards it, times its brightness
  double ambient = 0.45;

  OutlineModel outline(const Intrinsics& camera) const {
    const auto ellipse = sphere_outline(camera, in_camera, kRadius_m);
    return {camera, ellipse->centre_px, ellipse->radius_px()};
  }
};

// The light source stands up to 120 degrees beside the camera: from further behind it lights nothing but the
// rim itself.
LitBall any_ball(painter::Dice& dice) {
  const double z = dice.uniform(0.4, 3.0);
  const Eigen::Vector3d ball(dice.uniform(-0.4, 0.4) * z, dice.uniform(-0.3, 0.3) * z, z);
  Eigen::Vector3d towards(dice.normal(), dice.normal(), dice.normal());
  while (towards.normalized().dot(ball.normalized()) > 0.5)
    towards = {dice.normal(), dice.normal(), dice.normal()};
  return {ball, 0.55 * towards.normalized()};
}

Eigen::Vector3d sight_of(const Intrinsics& camera, const Eigen::Vector2d& pixel) {
  return {(pixel.x() - camera.cx_px) / camera.focal_px, (pixel.y() - camera.cy_px) / camera.focal_px, 1.0};
}

// Where a ray meets the ball first, as a direction from its centre; where it passes, its nearest point.
Eigen::Vector3d normal_met(const LitBall& ball, const Eigen::Vector3d& sight) {
  const Eigen::Vector3d way = sight.normalized();
  const double along = way.dot(ball.in_camera);
  const double gap = (along * way - ball.in_camera).norm();
  const double before = gap < kRadius_m ? std::sqrt(kRadius_m * kRadius_m - gap * gap) : 0.0;
  return ((along - before) * way - ball.in_camera).normalized();
}

Eigen::Vector3d light_on(const LitBall& ball, const Eigen::Vector3d& normal) {
  return kPaint * (ball.ambient + std::max(0.0, normal.dot(ball.light_source)));
}

// The ball before grey, its pixels without any that mix.
cv::Mat picture(const LitBall& ball, const Intrinsics& camera, double noise_levels, painter::Dice& dice) {
  cv::Mat image(camera.height_px, camera.width_px, CV_8UC3, cv::Scalar(130, 130, 130));
  const OutlineModel outline = ball.outline(camera);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      if (outline.level(Eigen::Vector2d(x, y)) > 1.0) continue;
      const Eigen::Vector3d light = light_on(ball, normal_met(ball, sight_of(camera, {x, y})));
      for (int c = 0; c < 3; ++c)
        image.at<cv::Vec3b>(y, x)[c] =
            cv::saturate_cast<std::uint8_t>(light[c] + noise_levels * dice.normal());
    }
  }
  return image;
}

// How far the shades along the outline are off, rms over its points and channels, levels.
double off_at_rim(const Shading& shading, const LitBall& ball, const Intrinsics& camera) {
  const OutlineModel outline = ball.outline(camera);
  double squares = 0.0;
  constexpr int kPoints = 90;
  for (int i = 0; i < kPoints; ++i) {
    const double turn = 2.0 * 3.14159265358979 * i / kPoints;
    const Eigen::Vector2d out(std::cos(turn), std::sin(turn));
    const Eigen::Vector2d at = outline.centre_px() + out / outline.level(outline.centre_px() + out);
    squares += (shading.at(at) - light_on(ball, normal_met(ball, sight_of(camera, at)))).squaredNorm();
  }
  return std::sqrt(squares / (3.0 * kPoints));
}

// Meant for whole outlines from half a metre to the corner of the picture; beyond the outline the nearest
// point counts. Mutations: the ellipse's centre taken for the ball's; the farther side of the ball.
TEST(BallSurface, FacesWhereSightlinesMeetIt) {
  const Intrinsics camera;
  painter::Dice dice(1);
  for (int i = 0; i < 2000; ++i) {
    const LitBall ball = any_ball(dice);
    const OutlineModel outline = ball.outline(camera);
    const double reach = 1.2 * outline.radius_px();
    const Eigen::Vector2d at =
        outline.centre_px() + reach * Eigen::Vector2d(dice.uniform(-1.0, 1.0), dice.uniform(-1.0, 1.0));
    const Eigen::Vector3d expected = normal_met(ball, sight_of(camera, at));
    ASSERT_LT((BallSurface(camera, outline).normal(at) - expected).norm(), 1e-6) << "ball " << i;
  }
}

// In the noise of a usual camera the rim is predicted to half a level. Mutations: the light source fitted
// once only; lit where it is turned away.
TEST(Shading, TellsTheColoursOfTheRim) {
  const Intrinsics camera;
  painter::Dice dice(2);
  double squares = 0.0;
  constexpr int kBalls = 150;
  for (int i = 0; i < kBalls; ++i) {
    const LitBall ball = any_ball(dice);
    const auto shading = fit_shading(picture(ball, camera, 2.0, dice), camera, ball.outline(camera),
                                     Shades(kPaint, 2.0), 4.0, std::nullopt);
    ASSERT_TRUE(shading);
    const double off = off_at_rim(*shading, ball, camera);
    EXPECT_LT(off, 3.0) << "ball " << i;
    squares += off * off;
  }
  EXPECT_LT(std::sqrt(squares / kBalls), 0.6);
}

// What hides a part of the ball does not count. Mutation: every pixel does.
TEST(Shading, LooksAtTheBallOnly) {
  const Intrinsics camera;
  painter::Dice dice(3);
  for (int i = 0; i < 20; ++i) {
    LitBall ball = any_ball(dice);
    ball.light_source = {-std::abs(ball.light_source.x()), ball.light_source.y(),
                         -std::abs(ball.light_source.z())};  // on what is left to see
    cv::Mat image = picture(ball, camera, 0.0, dice);
    const OutlineModel outline = ball.outline(camera);
    const auto edge = static_cast<int>(outline.centre_px().x() + 0.3 * outline.radius_px());
    image.colRange(std::clamp(edge, 0, image.cols - 1), image.cols).setTo(cv::Scalar(90, 90, 90));
    const auto shading = fit_shading(image, camera, outline, Shades(kPaint, 1.0), 1.0, std::nullopt);
    ASSERT_TRUE(shading);
    EXPECT_LT(off_at_rim(*shading, ball, camera), 2.0) << "ball " << i;
  }
}

// A ball that is seen from its unlit side has a light source somewhere behind it, and does not say that it
// has none; what shows its light source does. Mutation: any light source counts, however faint.
TEST(Shading, KnowsWhetherItShowsALamp) {
  const Intrinsics camera;
  painter::Dice dice(4);
  for (int i = 0; i < 60; ++i) {
    LitBall ball = any_ball(dice);
    const auto shows_light_source = [&] {
      const auto shading = fit_shading(picture(ball, camera, 2.0, dice), camera, ball.outline(camera),
                                       Shades(kPaint, 2.0), 4.0, std::nullopt);
      return shading && shading->light().shows_light_source;
    };
    ball.light_source = {0.4, -0.3, -0.3};
    EXPECT_TRUE(shows_light_source()) << "ball " << i;
    ball.light_source = 0.55 * ball.in_camera.normalized();
    EXPECT_FALSE(shows_light_source()) << "ball " << i << " is lit from behind";
    ball.light_source.setZero();
    EXPECT_FALSE(shows_light_source()) << "ball " << i << " has no lamp";
  }
}

// Mutation: no least number of samples.
TEST(Shading, IsUnknownWhereTooLittleIsSeen) {
  const Intrinsics camera;
  const OutlineModel tiny(camera, {500.0, 300.0}, 2.0);
  const cv::Mat grey(camera.height_px, camera.width_px, CV_8UC3, cv::Scalar(130, 130, 130));
  const Shades shades(kPaint, 1.0);
  EXPECT_FALSE(fit_shading(grey, camera, {camera, {500.0, 300.0}, 40.0}, shades, 1.0, std::nullopt));
  EXPECT_FALSE(fit_shading(cv::Mat(grey.size(), CV_8UC3, cv::Scalar(40, 120, 220)), camera, tiny, shades, 1.0,
                           std::nullopt));
  EXPECT_FALSE(fit_shading(grey, camera, {camera, {-500.0, 300.0}, 40.0}, shades, 1.0, std::nullopt))
      << "out of the picture";
}

}  // namespace
}  // namespace stereobench::vision
