#include "slam/models/measurement.h"

#include <limits>

#include <gtest/gtest.h>

#include "tests/slam/checks.h"

namespace stereobench::slam {
namespace {

// Errata: eq. 5 has atan2(dx, dy). Catches swapped arguments and a bearing that is not wrapped.
TEST(PredictSighting, BearingIsLeftPositiveFromTheHeading) {
  const Pose east{1.0, 2.0, 0.0};
  EXPECT_TRUE(near(predict_sighting(east, {4.0, 2.0}), Eigen::Vector2d(3.0, 0.0), 1e-15));
  EXPECT_TRUE(near(predict_sighting(east, {1.0, 4.0}), Eigen::Vector2d(2.0, M_PI / 2.0), 1e-15));
  EXPECT_TRUE(near(predict_sighting(east, {1.0, 1.0}), Eigen::Vector2d(1.0, -M_PI / 2.0), 1e-15));
  const Pose west{0.0, 0.0, 3.0};
  EXPECT_TRUE(near(predict_sighting(west, {-1.0, -0.1}),
                   Eigen::Vector2d(std::sqrt(1.01), std::atan(0.1) + M_PI - 3.0), 1e-12));
}

TEST(PredictSighting, AndLocateUndoEachOther) {
  RandomStream random(4, Stream::kWorld);
  for (int i = 0; i < 200; ++i) {
    const Pose robot{random.normal(), random.normal(), wrap_angle(3.0 * random.normal())};
    const Eigen::Vector2d point(5.0 * random.normal(), 5.0 * random.normal());
    EXPECT_TRUE(near(locate(robot, predict_sighting(robot, point)), point, 1e-12));
  }
}

TEST(PredictSighting, OfTwoViewsIsThatOfEach) {
  RandomStream random(4, Stream::kWorld);
  const auto any = [&] {
    return View{{random.normal(), random.normal(), wrap_angle(3.0 * random.normal())},
                {5.0 * random.normal(), 5.0 * random.normal()}};
  };
  for (int i = 0; i < 200; ++i) {
    const View a = any(), b = any();
    const Eigen::Matrix2d seen = predict_sightings(a, b);
    EXPECT_EQ(seen.col(0), predict_sighting(a.robot, a.point));
    EXPECT_EQ(seen.col(1), predict_sighting(b.robot, b.point));
  }
}

TEST(PredictSighting, IsFiniteOnTopOfTheLandmark) {
  EXPECT_TRUE(near(predict_sighting({1.0, 1.0, 0.5}, {1.0, 1.0}), Eigen::Vector2d(0.0, -0.5), 1e-15));
}

// Against central differences. Mutations: the sign of by_landmark's third entry, +1 for the heading's slope.
TEST(LinearSighting, PredictsTheSameAndHasItsSlopes) {
  constexpr double kStep = 1e-6;
  RandomStream random(5, Stream::kWorld);
  for (int i = 0; i < 200; ++i) {
    const Pose robot{random.normal(), random.normal(), wrap_angle(3.0 * random.normal())};
    const double direction = 3.0 * random.normal();
    const double range = 0.5 + 10.0 * random.uniform();
    const Eigen::Vector2d point = locate(robot, {range, direction});
    const LinearSighting linear = linearise_sighting(robot, point);
    EXPECT_EQ(linear.expected, predict_sighting(robot, point));
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(axis);
      const Eigen::Vector2d by_pose = sighting_residual(predict_sighting(boxplus(robot, step), point),
                                                        predict_sighting(boxplus(robot, -step), point)) /
                                      (2.0 * kStep);
      EXPECT_TRUE(near(linear.by_pose().col(axis), by_pose, 1e-7));
      if (axis < 2) {
        EXPECT_TRUE(near(linear.by_landmark.col(axis), -by_pose, 1e-7));
      }
    }
  }
  const LinearSighting none = linearise_sighting({1.0, 1.0, 0.5}, {1.0, 1.0});
  EXPECT_TRUE(none.by_landmark.isZero());
}

// A public implementation wraps the range in place of the bearing.
TEST(SightingResidual, WrapsTheBearingAndNotTheRange) {
  const Eigen::Vector2d residual = sighting_residual({10.0, 3.1}, {1.0, -3.1});
  EXPECT_DOUBLE_EQ(residual.x(), 9.0);
  EXPECT_NEAR(residual.y(), 6.2 - 2.0 * M_PI, 1e-15);
}

TEST(IsValid, RefusesSightingsThatCannotBe) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const RangeBearing good = sighting({1.0, 0.2}, 0.1, 0.01);
  EXPECT_TRUE(is_valid(good));
  EXPECT_TRUE(is_valid(sighting({0.0, 0.0}, 0.0, 0.0)));
  const auto broken = [&](auto change) {
    RangeBearing bad = good;
    change(bad);
    return !is_valid(bad);
  };
  EXPECT_TRUE(broken([&](RangeBearing& s) { s.range_m = nan; }));
  EXPECT_TRUE(broken([&](RangeBearing& s) { s.bearing_rad = nan; }));
  EXPECT_TRUE(broken([&](RangeBearing& s) { s.range_m = -0.1; }));
  EXPECT_TRUE(broken([&](RangeBearing& s) { s.covariance(0, 0) = nan; }));
  EXPECT_TRUE(broken([&](RangeBearing& s) { s.covariance(1, 1) = -1e-6; }));
  EXPECT_TRUE(broken([&](RangeBearing& s) { s.covariance(0, 1) = 1e-4; }));
  EXPECT_TRUE(broken([&](RangeBearing& s) { s.covariance(0, 1) = s.covariance(1, 0) = 1.0; }));
}

}  // namespace
}  // namespace stereobench::slam
