/// What hides a ball, and where something can stand, against points of triangles looked at one by one.
///
/// Mutations seen red here: triangles not cut; sight that goes on below floors; the rim counted; no slack;
/// cones that begin in the camera; slack not taken off what is excused; nothing excused; a circle in the
/// middle of a triangle, or across its edge, not met. Not caught: cones cut at the ball's middle, which
/// differ inside it.
#include "worlds/visibility/clearance_volume.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/worlds/visibility/triangles.h"

namespace stereobench::worlds {
namespace {

using Eigen::Vector3d;

const Eigen::Affine3d kHere = Eigen::Affine3d::Identity();

/// Points all over a triangle, its corners and edges too, not farther apart than a fortieth of its edges.
std::vector<Vector3d> points_of(const TriangleCorners& corners) {
  constexpr int kParts = 40;
  std::vector<Vector3d> points;
  for (int i = 0; i <= kParts; ++i)
    for (int k = 0; i + k <= kParts; ++k)
      points.push_back((i * corners[0] + k * corners[1] + (kParts - i - k) * corners[2]) / kParts);
  return points;
}

/// How far a point is beside what a camera looks through to see a ball but its rim: below zero it hides some.
double beside_volume_m(const Vector3d& camera_m, const Sphere& ball, const Vector3d& point) {
  const Vector3d sight = (ball.centre_m - camera_m).normalized();
  const double distance_m = (ball.centre_m - camera_m).norm();
  const double half_angle = std::asin((1.0 - kRim) * ball.radius_m / distance_m);
  const double ahead_m = (point - camera_m).dot(sight);
  const double aside_m = (point - camera_m - ahead_m * sight).norm();
  const double beside_m = aside_m * std::cos(half_angle) - ahead_m * std::sin(half_angle);
  const double behind_m = ahead_m - distance_m * std::pow(std::cos(half_angle), 2);
  const double within_m = ball.radius_m - (point - ball.centre_m).norm();
  return std::max({beside_m, behind_m, within_m, 0.01 - ahead_m});
}

struct Scene {
  Vector3d camera_m;
  Sphere ball;
  std::vector<TriangleCorners> triangles;
};

/// Balls and cameras beside triangles; a third of the triangles has a corner on the ball.
Scene random_scene(std::uint64_t seed, int triangles) {
  slam::RandomStream draws(seed, slam::Stream::kWorld, 77);
  Scene scene{random_in_box(draws, 0.5) - Vector3d(2.0, 0.0, 0.0),
              {random_in_box(draws, 0.5) + Vector3d(0.5, 0.0, 0.0), 0.05 + 0.25 * draws.uniform()},
              random_triangles(draws, triangles, 0.3)};
  for (std::size_t i = 0; i < scene.triangles.size(); i += 3)
    scene.triangles[i][0] = scene.ball.centre_m + scene.ball.radius_m * random_in_box(draws, 0.9);
  return scene;
}

TEST(VisibilityVolume, IsMetByWhatHasAPointBetweenTheCameraAndTheBall) {
  int met = 0;
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    const Scene scene = random_scene(seed, 1 + static_cast<int>(seed % 8 == 0));
    double beside_m = 1e9, apart_m = 1e9;
    for (const TriangleCorners& corners : scene.triangles) {
      for (const Vector3d& point : points_of(corners)) {
        beside_m = std::min(beside_m, beside_volume_m(scene.camera_m, scene.ball, point));
        apart_m = std::min(apart_m, (point - scene.ball.centre_m).norm() - scene.ball.radius_m);
      }
    }
    const bool is_met =
        meets(visibility_volume(scene.camera_m, scene.ball, 0.0), TriangleBvh(scene.triangles), kHere);
    if (beside_m < -1e-3) {
      EXPECT_TRUE(is_met) << seed << ": " << beside_m;
    }
    if (beside_m > 0.02 && apart_m > 0.0) {  // what sticks in the ball and out of it may count
      EXPECT_FALSE(is_met) << seed << ": " << beside_m;
    }
    met += is_met ? 1 : 0;
  }
  EXPECT_GT(met, 300);
  EXPECT_LT(met, 1200);
}

TEST(VisibilityVolume, IsMetByManyIfByOne) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Scene scene = random_scene(seed, 12);
    const ClearanceVolume volume = visibility_volume(scene.camera_m, scene.ball, 0.02);
    const bool by_one = std::ranges::any_of(scene.triangles, [&](const TriangleCorners& corners) {
      return meets(volume, TriangleBvh({corners}), kHere);
    });
    EXPECT_EQ(meets(volume, TriangleBvh(scene.triangles), kHere), by_one) << seed;
  }
}

TEST(VisibilityVolume, MovedAndTurnedWithEverythingElseItIsMetAsBefore) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    Scene scene = random_scene(seed, 2);
    const double slack_m = seed % 2 == 0 ? 0.0 : 0.03;
    const TriangleBvh tree(scene.triangles);
    const bool before = meets(visibility_volume(scene.camera_m, scene.ball, slack_m), tree, kHere);
    slam::RandomStream draws(seed, slam::Stream::kWorld, 78);
    Eigen::Affine3d moved = Eigen::Affine3d::Identity();
    moved.translate(random_in_box(draws, 10.0))
        .rotate(Eigen::AngleAxisd(7.0 * draws.uniform(), Vector3d::UnitZ()));  // what is low stays low
    scene.ball.centre_m = moved * scene.ball.centre_m;
    EXPECT_EQ(meets(visibility_volume(moved * scene.camera_m, scene.ball, slack_m), tree, moved), before)
        << seed;
  }
}

// Whatever is hidden of a ball that lies a little aside is hidden of one that may lie there.
TEST(VisibilityVolume, WithSlackIsMetByWhatHidesTheBallAnywhereWithinIt) {
  constexpr double kSlack_m = 0.04;
  int met = 0;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    const Scene scene = random_scene(seed, 12);
    slam::RandomStream draws(seed, slam::Stream::kWorld, 79);
    Sphere aside = scene.ball;
    aside.centre_m +=
        Eigen::AngleAxisd(7.0 * draws.uniform(), Vector3d::UnitZ()) * Vector3d(kSlack_m, 0.0, 0.0);
    for (const TriangleCorners& corners : scene.triangles) {
      const TriangleBvh tree({corners});
      if (!meets(visibility_volume(scene.camera_m, aside, 0.0), tree, kHere)) continue;
      if (std::ranges::any_of(points_of(corners), [&](const Vector3d& point) {
            return (point - scene.ball.centre_m).norm() < scene.ball.radius_m + kSlack_m + 0.01;
          }))
        continue;  // nobody puts a ball there
      EXPECT_TRUE(meets(visibility_volume(scene.camera_m, scene.ball, kSlack_m), tree, kHere)) << seed;
      ++met;
    }
  }
  EXPECT_GT(met, 80);
}

TriangleBvh floor_at(double z_m) {
  return TriangleBvh({{Vector3d(-50, -50, z_m), Vector3d(50, -50, z_m), Vector3d(50, 50, z_m)},
                      {Vector3d(-50, -50, z_m), Vector3d(50, 50, z_m), Vector3d(-50, 50, z_m)}});
}

TEST(VisibilityVolume, AFloorHidesNothingOfABallOnItUnlessItSinks) {
  for (int i = 0; i < 600; ++i) {
    const double radius_m = 0.05 + 0.05 * (i % 3);
    const Vector3d camera_m(-0.7 - 0.05 * i, 0.3, 0.02 + 0.1 * (i % 17));
    const Sphere ball{{0.0, 0.0, radius_m}, radius_m};
    for (const double slack_m : {0.0, 0.03}) {
      const ClearanceVolume volume = visibility_volume(camera_m, ball, slack_m);
      EXPECT_FALSE(meets(volume, floor_at(0.0), kHere)) << i;
      EXPECT_FALSE(meets(volume, floor_at(std::min(0.9 * kRim * radius_m, camera_m.z() - 0.001)), kHere))
          << i;
      if (camera_m.z() > 0.6 * radius_m) {
        EXPECT_TRUE(meets(volume, floor_at(0.5 * radius_m), kHere)) << i;
      }
      EXPECT_FALSE(meets(volume, floor_at(2.5), kHere)) << "a ceiling";
    }
  }
}

/// A wall across the way, cut into triangles around a point of it.
std::vector<TriangleCorners> wall_around(const Vector3d& point, slam::RandomStream& draws) {
  std::vector<Vector3d> rim;
  const int count = 3 + static_cast<int>(9.0 * draws.uniform());
  const Vector3d lean = 0.3 * random_in_box(draws, 1.0);
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * M_PI * (i + 0.9 * draws.uniform()) / count;
    const Vector3d aside(0.0, std::cos(angle), std::sin(angle));
    rim.push_back(point + aside + Vector3d(lean.dot(aside), 0.0, 0.0));
  }
  std::vector<TriangleCorners> triangles;
  for (std::size_t i = 0; i < rim.size(); ++i)
    triangles.push_back({point, rim[i], rim[(i + 1) % rim.size()]});
  return triangles;
}

TEST(VisibilityVolume, NothingIsSeenThroughTheCracksBetweenTriangles) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    slam::RandomStream draws(seed, slam::Stream::kWorld, 80);
    const Vector3d point = random_in_box(draws, 1.0) + Vector3d(3.0, 0.0, 10.0);
    const std::vector<TriangleCorners> wall = wall_around(point, draws);
    const Vector3d camera_m = random_in_box(draws, 0.3) + Vector3d(0.0, 0.0, 10.0);
    const TriangleBvh tree(wall);
    // Through a shared corner, and through points of shared edges.
    const Vector3d& other = wall[seed % wall.size()][1];
    for (const double share : {0.0, draws.uniform(), draws.uniform()}) {
      const Vector3d aim = point + share * (other - point);
      const Sphere far{camera_m + 3.0 * (aim - camera_m), 1e-9};
      EXPECT_TRUE(meets(visibility_volume(camera_m, far, 0.0), tree, kHere)) << seed << " at " << share;
    }
  }
}

TEST(VisibilityVolume, WhatIsWithinTheBallHidesNothingAndWhatSticksOutDoes) {
  const Sphere ball{{3.0, 0.0, 0.5}, 0.2};
  const Vector3d camera_m(0.0, 0.0, 0.5);
  const auto rod = [](double from_x, double to_x) {
    return TriangleBvh({{Vector3d(from_x, 0.0, 0.5), Vector3d(to_x, 0.01, 0.5), Vector3d(to_x, -0.01, 0.5)}});
  };
  EXPECT_FALSE(meets(visibility_volume(camera_m, ball, 0.0), rod(2.85, 3.1), kHere));
  EXPECT_TRUE(meets(visibility_volume(camera_m, ball, 0.0), rod(2.75, 3.1), kHere));
  EXPECT_FALSE(meets(visibility_volume(camera_m, ball, 0.0), rod(3.25, 3.4), kHere)) << "behind it";
  EXPECT_FALSE(meets(visibility_volume(camera_m, ball, 0.0), rod(-0.5, 0.005), kHere))
      << "nearer than pictures begin";
  EXPECT_TRUE(meets(visibility_volume(camera_m, ball, 0.0), rod(-0.5, 0.02), kHere));
  EXPECT_TRUE(meets(visibility_volume(camera_m, ball, 0.06), rod(2.85, 3.1), kHere))
      << "the ball may lie behind it";
}

TEST(UprightCylinder, IsMetByWhatHasAPointInIt) {
  int met = 0;
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    slam::RandomStream draws(seed, slam::Stream::kWorld, 81);
    const std::vector<TriangleCorners> triangles = random_triangles(draws, 2, 0.4);
    const Eigen::Vector2d at = random_in_box(draws, 0.8).head<2>();
    const double radius_m = 0.5 * draws.uniform(), low_m = -0.5 * draws.uniform(), high_m = 0.4;
    double beside_m = 1e9;
    for (const TriangleCorners& corners : triangles)
      for (const Vector3d& point : points_of(corners))
        beside_m = std::min(beside_m, std::max({(point.head<2>() - at).norm() - radius_m, low_m - point.z(),
                                                point.z() - high_m}));
    const bool is_met = meets(upright_cylinder(at, radius_m, low_m, high_m), TriangleBvh(triangles), kHere);
    if (beside_m <= 0.0) {
      EXPECT_TRUE(is_met) << seed;
    }
    if (beside_m > 0.03) {
      EXPECT_FALSE(is_met) << seed << ": " << beside_m;
    }
    met += is_met ? 1 : 0;
  }
  EXPECT_GT(met, 100);
  EXPECT_LT(met, 1200);
}

// Meshes are drawn on grids, and so are heights: planes go through corners. Mutation: the origin inside by
// the sides of all edges, where a corner that a cut leaves twice has none.
TEST(UprightCylinder, IsMetByTrianglesThatHaveCornersOnItsPlanes) {
  const auto on_grid = [](const Vector3d& point) -> Vector3d {
    return (10.0 * point).array().round() / 10.0;
  };
  int met = 0;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    slam::RandomStream draws(seed, slam::Stream::kWorld, 82);
    TriangleCorners corners;
    for (Vector3d& corner : corners) {
      corner = on_grid(random_in_box(draws, 3.0));
      corner.z() = 0.1 * std::floor(4.0 * draws.uniform());
    }
    const Eigen::Vector2d at = random_in_box(draws, 1.0).head<2>();
    const bool has_point = std::ranges::any_of(points_of(corners), [&](const Vector3d& point) {
      return (point.head<2>() - at).norm() < 0.2 && point.z() > 0.1 - 1e-12 && point.z() < 0.2 + 1e-12;
    });
    if (!has_point) continue;
    EXPECT_TRUE(
        meets(upright_cylinder(at, 0.2 + 1e-9, 0.1 - 1e-9, 0.2 + 1e-9), TriangleBvh({corners}), kHere))
        << seed;
    EXPECT_TRUE(meets(upright_cylinder(at, 0.2, 0.1, 0.2), TriangleBvh({corners}), kHere)) << seed;
    ++met;
  }
  EXPECT_GT(met, 100);
}

}  // namespace
}  // namespace stereobench::worlds
