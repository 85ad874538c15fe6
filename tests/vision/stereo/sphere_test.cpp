#include "vision/stereo/sphere.h"

#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "tests/vision/painter.h"
#include "vision/camera/rig.h"

namespace stereobench::vision {
namespace {

constexpr int kSpheres = 2000;

struct Sphere {
  Eigen::Vector3d centre;
  double radius_m;
};

Sphere random_sphere(painter::Dice& dice) {
  const double radius = dice.uniform(0.02, 0.3);
  const double depth = dice.uniform(1.5 * radius, 15.0);
  return {{dice.uniform(-1.0, 1.0) * depth, dice.uniform(-1.0, 1.0) * depth, depth}, radius};
}

// Where a ray at an angle phi around the cone that touches the sphere meets the image: geometry, no ellipse.
Eigen::Vector2d tangent_pixel(const Intrinsics& camera, const Sphere& sphere, double phi) {
  const double distance = sphere.centre.norm();
  const Eigen::Vector3d n = sphere.centre / distance;
  const Eigen::Vector3d e1 = n.unitOrthogonal();
  const Eigen::Vector3d e2 = n.cross(e1);
  const double sine = sphere.radius_m / distance;
  const Eigen::Vector3d ray =
      std::sqrt(1.0 - sine * sine) * n + sine * (std::cos(phi) * e1 + std::sin(phi) * e2);
  return project(camera, ray);
}

// The outline's conic p' (cos^2 a I - n n') p = 0 in pixels; its centre is where the gradient vanishes.
Eigen::Vector2d conic_centre(const Intrinsics& camera, const Sphere& sphere) {
  Eigen::Matrix3d k = Eigen::Matrix3d::Identity();
  k(0, 0) = k(1, 1) = camera.focal_px;
  k(0, 2) = camera.cx_px;
  k(1, 2) = camera.cy_px;
  const Eigen::Vector3d n = sphere.centre.normalized();
  const double cos2 = 1.0 - sphere.radius_m * sphere.radius_m / sphere.centre.squaredNorm();
  const Eigen::Matrix3d inverse = k.inverse();
  const Eigen::Matrix3d conic =
      inverse.transpose() * (cos2 * Eigen::Matrix3d::Identity() - n * n.transpose()) * inverse;
  return -conic.topLeftCorner<2, 2>().inverse() * conic.topRightCorner<2, 1>();
}

// Catches: a dropped eccentricity correction (circle in place of ellipse), swapped axes, a wrong angle.
TEST(SphereOutline, EveryTangentRayMeetsTheEllipse) {
  painter::Dice dice(1);
  const Intrinsics camera;
  for (int i = 0; i < kSpheres; ++i) {
    const Sphere sphere = random_sphere(dice);
    const auto ellipse = sphere_outline(camera, sphere.centre, sphere.radius_m);
    ASSERT_TRUE(ellipse.has_value());
    const Eigen::Vector2d p = tangent_pixel(camera, sphere, dice.uniform(0.0, 6.283)) - ellipse->centre_px;
    const Eigen::Vector2d major(std::cos(ellipse->angle_rad), std::sin(ellipse->angle_rad));
    const double along = p.dot(major) / ellipse->semi_major_px;
    const double across = (p.x() * major.y() - p.y() * major.x()) / ellipse->semi_minor_px;
    ASSERT_NEAR(along * along + across * across, 1.0, 1e-8) << "sphere " << i;
  }
}

// Catches: the ball's projected centre taken for the ellipse's, (1 + b^2) missing or inverted.
TEST(SphereOutline, CentreIsThatOfTheConic) {
  painter::Dice dice(2);
  const Intrinsics camera;
  for (int i = 0; i < kSpheres; ++i) {
    const Sphere sphere = random_sphere(dice);
    const auto ellipse = sphere_outline(camera, sphere.centre, sphere.radius_m);
    ASSERT_TRUE(ellipse.has_value());
    ASSERT_LT((ellipse->centre_px - conic_centre(camera, sphere)).norm(), 1e-6) << "sphere " << i;
  }
}

TEST(SphereOutline, IsEmptyUnlessTheWholeBallIsAhead) {
  EXPECT_FALSE(sphere_outline({}, {0.0, 0.0, -1.0}, 0.05));
  EXPECT_FALSE(sphere_outline({}, {0.3, 0.0, 0.05}, 0.05));
  EXPECT_FALSE(sphere_outline({}, {0.0, 0.0, std::nan("")}, 0.05));
  EXPECT_TRUE(sphere_outline({}, {0.3, 0.0, 0.06}, 0.05));
}

// Catches: front-surface depth (Z - R), uncorrected Z - R^2/Z, the projected centre, a baseline of the wrong
// sign, half a pixel in one camera.
// Law: the outline is sphere_outline's, and its derivative that of small changes of place and size.
// Mutation: the radius' share of the centre's change left out.
TEST(SeenOutline, IsTheEllipseAndItsDerivative) {
  painter::Dice dice(8);
  const Intrinsics camera;
  for (int i = 0; i < kSpheres; ++i) {
    const Sphere sphere = random_sphere(dice);
    SizedBall ball;
    ball << sphere.centre, sphere.radius_m;
    const SeenOutline seen = seen_outline(camera, ball);
    const auto ellipse = sphere_outline(camera, sphere.centre, sphere.radius_m);
    ASSERT_LT((seen.outline_px.head<2>() - ellipse->centre_px).norm(), 1e-7);
    ASSERT_NEAR(seen.outline_px.z(), ellipse->radius_px(), 1e-7);
    for (int k = 0; k < 4; ++k) {
      const SizedBall step = 1e-6 * SizedBall::Unit(k);
      const Eigen::Vector3d change =
          (seen_outline(camera, ball + step).outline_px - seen_outline(camera, ball - step).outline_px) /
          2e-6;
      ASSERT_LT((change - seen.by_ball.col(k)).norm(), 1e-4 * (1.0 + seen.by_ball.col(k).norm())) << k;
    }
  }
}

TEST(TriangulateBall, UndoesTheProjectionOfOutlines) {
  painter::Dice dice(3);
  const StereoRig rig;
  for (int i = 0; i < kSpheres; ++i) {
    const Sphere sphere = random_sphere(dice);
    const Sphere in_right{camera_point(rig, sphere.centre, Side::kRight), sphere.radius_m};
    const auto ball = triangulate_ball(rig, conic_centre(rig.intrinsics, sphere),
                                       conic_centre(rig.intrinsics, in_right), sphere.radius_m);
    ASSERT_TRUE(ball.has_value());
    ASSERT_LT((*ball - sphere.centre).norm(), 1e-6 * sphere.centre.norm()) << "sphere " << i;
  }
}

// Catches: swapped cameras.
TEST(TriangulateBall, NeedsAPositiveDisparity) {
  const StereoRig rig;
  EXPECT_TRUE(triangulate_ball(rig, {520.0, 300.0}, {500.0, 300.0}, 0.05));
  EXPECT_FALSE(triangulate_ball(rig, {500.0, 300.0}, {520.0, 300.0}, 0.05));
  EXPECT_FALSE(triangulate_ball(rig, {500.0, 300.0}, {500.0, 300.0}, 0.05));
  EXPECT_FALSE(triangulate_ball(rig, {std::nan(""), 300.0}, {500.0, 300.0}, 0.05));
}

}  // namespace
}  // namespace stereobench::vision
