// Laws of drives: lengths, closure, smoothness, and controls that lead from pose to pose.
#include "worlds/drive/path.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "slam/math/angles.h"
#include "slam/models/motion.h"

namespace stereobench::worlds {
namespace {

PolylinePath rectangle() {
  PolylinePath path;
  path.points_m = {{-5, -3}, {5, -3}, {5, 3}, {-5, 3}};
  path.closed = true;
  path.corner_radius_m = 1.0;
  path.speed_mps = 0.7;
  path.step_s = 0.5;
  return path;
}

double duration_s(const PathStep& step) {
  double sum_s = 0.0;
  for (const slam::Control& control : step.controls) sum_s += control.duration_s;
  return sum_s;
}

double distance_m(const slam::Pose& a, const slam::Pose& b) {
  return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m);
}

class CircleLaw : public testing::TestWithParam<double> {};

// Catches: a turn rate that is not v / r, one step too few, stamps that are not multiples of the step.
TEST_P(CircleLaw, ReturnsToItsStartAfterEachLap) {
  const double radius_m = GetParam();
  const CirclePath circle = {{0.3, -2.0, 0.4}, radius_m, radius_m * slam::kPi / 36, 2.0, 2.0};
  const GroundTruth path = drive_circle(circle);
  ASSERT_EQ(path.size(), 73U);
  EXPECT_TRUE(path[0].controls.empty());
  EXPECT_EQ(path[0].stamp_ns, 0);
  EXPECT_TRUE(distance_m(path[36].pose, circle.start) < 1e-9 * radius_m);
  EXPECT_TRUE(distance_m(path[72].pose, circle.start) < 1e-9 * radius_m);
  EXPECT_TRUE(std::abs(slam::wrap_angle(path[72].pose.heading_rad - 0.4)) < 1e-9);
  EXPECT_EQ(path[72].stamp_ns, 144000000000);
  EXPECT_NEAR(length_m(path), 4 * slam::kPi * radius_m, 1e-9 * radius_m);
}

// Catches: a circle to the right.
TEST_P(CircleLaw, KeepsItsDistanceFromTheCentreOnTheLeft) {
  const double radius_m = GetParam();
  for (const PathStep& step : drive_circle({{1, 2, 0}, radius_m, 0.3 * radius_m, 1.0, 0.7})) {
    EXPECT_NEAR(std::hypot(step.pose.x_m - 1, step.pose.y_m - 2 - radius_m), radius_m, 1e-12 * radius_m);
  }
}
INSTANTIATE_TEST_SUITE_P(Radii, CircleLaw, testing::Values(0.05, 1.0, 40.0));

TEST(Circle, EndsWithAShorterStepWhenTheLapIsNoMultiple) {
  const GroundTruth path = drive_circle({{}, 1.0, 1.0, 1.0, 1.0});  // 6.283 s
  ASSERT_EQ(path.size(), 8U);
  EXPECT_NEAR(duration_s(path.back()), 2 * slam::kPi - 6, 1e-12);
  EXPECT_EQ(path.back().stamp_ns, std::llround(2 * slam::kPi * 1e9));
  EXPECT_TRUE(distance_m(path.back().pose, path.front().pose) < 1e-9);
}

// Half steps lead to the same places. Catches: controls whose duration is not the step's.
TEST(Drive, InHalfStepsPassesTheSamePoses) {
  PolylinePath polyline = rectangle();
  const GroundTruth coarse = drive_polyline(polyline);
  polyline.step_s /= 2;
  const GroundTruth fine = drive_polyline(polyline);
  for (std::size_t k = 0; 2 * k < fine.size() && k + 1 < coarse.size(); ++k) {
    EXPECT_TRUE(distance_m(coarse[k].pose, fine[2 * k].pose) < 1e-8) << k;
    EXPECT_EQ(coarse[k].stamp_ns, fine[2 * k].stamp_ns);
  }
}

// What the filters rely on: odometry without noise is exactly the truth.
TEST(Drive, ControlsLeadFromPoseToPose) {
  const GroundTruth path = drive_polyline(rectangle());
  slam::Pose pose = path.front().pose;
  for (const PathStep& step : path) {
    for (const slam::Control& control : step.controls) pose = slam::advance(pose, control);
    EXPECT_EQ(pose.x_m, step.pose.x_m);
    EXPECT_EQ(pose.y_m, step.pose.y_m);
    EXPECT_EQ(pose.heading_rad, step.pose.heading_rad);
  }
}

// Catches: a boundary inside a piece that loses or repeats time.
TEST(Drive, EachStepTakesItsTime) {
  const GroundTruth path = drive_polyline(rectangle());
  std::size_t mixed = 0;
  for (std::size_t k = 1; k < path.size(); ++k) {
    EXPECT_EQ(path[k - 1].stamp_ns, std::int64_t{500000000} * static_cast<std::int64_t>(k - 1));
    if (k + 1 < path.size()) {
      EXPECT_NEAR(duration_s(path[k]), 0.5, 2e-9);
    }
    if (path[k].controls.size() > 1) ++mixed;
  }
  EXPECT_EQ(mixed, 7U) << "every end of a straight or an arc but the last one falls inside a step";
}

// Catches: arcs of the wrong radius, an edge too long by its tangents, a lap that does not close.
TEST(ClosedPolyline, HasTheLengthOfItsStraightsAndArcsAndCloses) {
  const GroundTruth path = drive_polyline(rectangle());
  EXPECT_NEAR(length_m(path), 2 * (10 + 6) - 8 + 2 * slam::kPi, 1e-7);
  EXPECT_TRUE(distance_m(path.front().pose, {-4, -3, 0}) < 1e-12);
  EXPECT_TRUE(distance_m(path.back().pose, path.front().pose) < 1e-7);
  EXPECT_TRUE(std::abs(path.back().pose.heading_rad) < 1e-7);
}

TEST(ClosedPolyline, DrivesOnIntoTheNextLap) {
  PolylinePath polyline = rectangle();
  polyline.overlap_m = 9.0;  // past the first corner: 8 m of straight, 1 m of arc
  const GroundTruth path = drive_polyline(polyline);
  EXPECT_NEAR(length_m(path), 2 * (10 + 6) - 8 + 2 * slam::kPi + 9, 1e-7);
  EXPECT_TRUE(distance_m(path.back().pose, {4 + std::sin(1.0), -2 - std::cos(1.0), 0}) < 1e-7);
}

// Left and right turns, sharp and blunt: headings are those of the edges, and turn no faster than v / r.
// Catches: a right turn taken as a left one.
TEST(OpenPolyline, FollowsItsEdgesWithoutAKink) {
  PolylinePath path;
  path.points_m = {{0, 0}, {10, 0}, {10, -8}, {18, -8}, {26, -2}, {22, 9}};
  path.corner_radius_m = 1.5;
  path.step_s = 0.1;
  const GroundTruth drive = drive_polyline(path);
  for (std::size_t k = 1; k < drive.size(); ++k) {
    const double turn_rad = slam::wrap_angle(drive[k].pose.heading_rad - drive[k - 1].pose.heading_rad);
    EXPECT_TRUE(std::abs(turn_rad) <= 0.1 / 1.5 + 1e-9) << k;
    EXPECT_TRUE(distance_m(drive[k].pose, drive[k - 1].pose) <= 0.1 + 1e-9) << k;
  }
  EXPECT_TRUE(distance_m(drive.back().pose, {22, 9, 0}) < 1e-7);
  EXPECT_NEAR(drive.back().pose.heading_rad, std::atan2(11, -4), 1e-7);
}

// However often the odometry is read, the robot drives as it did; a reading spans its time, but where a
// straight meets an arc and at the end of a step. Catches: time lost or driven twice at a reading, readings
// that count from the start of a piece and not of the step.
TEST(Drive, ReadingTheOdometryOftenMovesNothing) {
  PolylinePath polyline = rectangle();
  const GroundTruth once = drive_polyline(polyline);
  for (const double odometry_s : {0.0625, 0.07, 0.5, 3.0}) {
    polyline.odometry_s = odometry_s;
    const GroundTruth often = drive_polyline(polyline);
    ASSERT_EQ(often.size(), once.size());
    const double readings = std::ceil(0.5 / odometry_s);
    for (std::size_t k = 1; k < once.size(); ++k) {
      EXPECT_TRUE(distance_m(often[k].pose, once[k].pose) < 1e-9) << k;
      EXPECT_NEAR(duration_s(often[k]), duration_s(once[k]), 1e-9);
      for (const slam::Control& control : often[k].controls) EXPECT_LE(control.duration_s, odometry_s + 1e-9);
      if (k + 1 < once.size()) {
        EXPECT_NEAR(static_cast<double>(often[k].controls.size()),
                    readings + static_cast<double>(once[k].controls.size() - 1), 1e-9);
      }
    }
  }
}

// Catches: poses that do not follow from the readings.
TEST(Drive, ReadingsLeadFromPoseToPose) {
  const GroundTruth path = drive_circle({{0.3, -2.0, 0.4}, 1.0, 0.3, 1.5, 0.8, 0.1});
  slam::Pose pose = path.front().pose;
  for (const PathStep& step : path) {
    for (const slam::Control& control : step.controls) pose = slam::advance(pose, control);
    EXPECT_EQ(pose.x_m, step.pose.x_m);
    EXPECT_EQ(pose.heading_rad, step.pose.heading_rad);
  }
  EXPECT_EQ(path[1].controls.size(), 8U);
}

// Catches: a side of the step taken for the other, controls not reversed on the way back, ends that are
// passed.
TEST(Drive, IsFollowedBetweenItsSteps) {
  PolylinePath rounded = rectangle();
  rounded.odometry_s = 0.1;
  const GroundTruth path = drive_polyline(rounded);
  for (std::size_t k = 1; k + 1 < path.size(); ++k) {
    const double ahead_s = duration_s(path[k + 1]);
    const double behind_s = duration_s(path[k]);
    EXPECT_LT(distance_m(pose_near(path, k, ahead_s), path[k + 1].pose), 1e-12);
    EXPECT_LT(distance_m(pose_near(path, k, -behind_s), path[k - 1].pose), 1e-12);
    EXPECT_NEAR(distance_m(pose_near(path, k, 0.01), path[k].pose), 0.007, 1e-6);
    const slam::Pose between = pose_near(path, k, 0.3 * ahead_s);
    const slam::Pose same = pose_near(path, k + 1, -0.7 * ahead_s);
    EXPECT_LT(distance_m(between, same), 1e-12);
    EXPECT_NEAR(slam::wrap_angle(between.heading_rad - same.heading_rad), 0.0, 1e-12);
  }
  EXPECT_EQ(distance_m(pose_near(path, 0, -1.0), path.front().pose), 0.0);
  EXPECT_EQ(distance_m(pose_near(path, path.size() - 1, 1.0), path.back().pose), 0.0);
}

TEST(Drive, RefusesWhatCannotBeDriven) {
  EXPECT_THROW(drive_circle({{}, 0.0, 1, 1, 1}), std::invalid_argument);
  EXPECT_THROW(drive_circle({{}, 1, -1, 1, 1}), std::invalid_argument);
  EXPECT_THROW(drive_circle({{}, 1, 1, std::numeric_limits<double>::quiet_NaN(), 1}), std::invalid_argument);
  EXPECT_THROW(drive_circle({{}, 1, 1, 1, 0}), std::invalid_argument);
  EXPECT_THROW(drive_circle({{}, 1, 1, 1, 1e-9}), std::invalid_argument);
  for (const double odometry_s : {-0.1, 1e-12, 1e-6, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(drive_circle({{}, 1, 1, 1, 1, odometry_s}), std::invalid_argument);
  PolylinePath path = rectangle();
  path.corner_radius_m = 3.1;
  EXPECT_THROW(drive_polyline(path), std::invalid_argument);
  path.corner_radius_m = 3.0;
  EXPECT_NO_THROW(drive_polyline(path)) << "arcs may touch";
}

}  // namespace
}  // namespace stereobench::worlds
