/// Drives without corners: figure eights, splines, recorded trajectories, and the biarcs they are made of.

#include "worlds/drive/smooth_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "slam/math/random.h"
#include "slam/models/belief.h"
#include "slam/models/motion.h"
#include "tests/complaint.h"
#include "tests/slam/checks.h"
#include "tests/worlds/scenario/scenario_text.h"
#include "worlds/drive/biarc.h"

namespace stereobench::worlds {
namespace {

using slam::near;
using slam::Pose;

/// The pose after two arcs.
Pose end_of(const Pose& from, const std::array<Arc, 2>& arcs) {
  Pose pose = from;
  for (const Arc& arc : arcs) pose = slam::advance(pose, {arc.length_m, arc.turn_rad, 1.0});
  return pose;
}

// Mutations: the second arc's turn with the wrong sign; the whole chord for its half.
TEST(Biarc, ArrivesWhereItShouldAndTurnsTheSameWayBackwards) {
  slam::RandomStream random(11, slam::Stream::kWorld);
  for (int i = 0; i < 500; ++i) {
    const Pose from{random.normal(), random.normal(), slam::wrap_angle(3.0 * random.normal())};
    const Pose to{3.0 * random.normal(), random.normal(), slam::wrap_angle(3.0 * random.normal())};
    const auto arcs = biarc(from, to);
    ASSERT_TRUE(arcs);
    EXPECT_TRUE(near(slam::boxminus(end_of(from, *arcs), to), Eigen::Vector3d::Zero().eval(), 1e-9)) << i;
    const double ahead =
        std::cos(from.heading_rad) * (to.x_m - from.x_m) + std::sin(from.heading_rad) * (to.y_m - from.y_m);
    EXPECT_EQ(arcs->at(0).length_m > 0.0, ahead > 0.0);
    EXPECT_EQ(arcs->at(0).length_m > 0.0, arcs->at(1).length_m > 0.0);
  }
}

// Two points of a circle, or of a line, are joined by it.
TEST(Biarc, IsTheCircleWhereThereIsOne) {
  for (const double turn : {-2.0, -0.3, 0.0, 1e-6, 1.0, 3.0}) {
    const Pose from{0.5, -0.2, 0.7};
    const Pose to = slam::advance(from, {2.0, turn, 1.0});
    const auto arcs = biarc(from, to);
    ASSERT_TRUE(arcs);
    EXPECT_NEAR(arcs->at(0).length_m + arcs->at(1).length_m, 2.0, 1e-9);
    EXPECT_NEAR(arcs->at(0).turn_rad, 0.5 * turn, 1e-9);
    EXPECT_NEAR(arcs->at(1).turn_rad, 0.5 * turn, 1e-9);
  }
  EXPECT_FALSE(biarc({}, {0.0, 0.0, 1.0}));
  EXPECT_FALSE(biarc({}, {0.0, 1.0, 0.0}));
}

TEST(FigureEight, CrossesItsStartAndEndsThere) {
  const GroundTruth path = drive_figure_eight({{1.0, 2.0, 0.5}, 2.0, 1.0, 1.0, 0.1, 0.0});
  EXPECT_NEAR(length_m(path), 8.0 * std::numbers::pi, 1e-9);
  EXPECT_TRUE(near(slam::boxminus(path.back().pose, {1.0, 2.0, 0.5}), Eigen::Vector3d::Zero().eval(), 1e-9));
  EXPECT_GT(path[5].controls[0].w_radps, 0.0);
  EXPECT_LT(path[path.size() - 5].controls[0].w_radps, 0.0);
  const GroundTruth half = drive_figure_eight({{1.0, 2.0, 0.5}, 2.0, 1.0, 0.5, 0.1, 0.0});
  EXPECT_TRUE(near(slam::boxminus(half.back().pose, {1.0, 2.0, 0.5}), Eigen::Vector3d::Zero().eval(), 1e-9));
  EXPECT_THROW(drive_figure_eight({{}, -1.0, 1.0, 1.0, 0.1, 0.0}), std::invalid_argument);
  EXPECT_THROW(drive_figure_eight({{}, 1.0, 1.0, -1.0, 0.1, 0.0}), std::invalid_argument);
}

// Mutation: headings from the point itself to the next.
TEST(Spline, GoesThroughItsPointsWithoutAKink) {
  const std::vector<Eigen::Vector2d> points = {{0.0, 0.0}, {2.0, 0.5}, {3.0, 2.0}, {1.0, 3.0}, {-1.0, 1.5}};
  for (const bool closed : {false, true}) {
    const GroundTruth path = drive_spline({points, closed, 1.0, 0.01, 0.0});
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto off_m = [&](const PathStep& step) {
        return (Eigen::Vector2d(step.pose.x_m, step.pose.y_m) - points[i]).norm();
      };
      const PathStep& nearest = *std::ranges::min_element(path, {}, off_m);
      EXPECT_LT(off_m(nearest), 0.006) << i;
      if (i == 0 || i + 1 == points.size()) continue;
      const Eigen::Vector2d along = points[i + 1] - points[i - 1];
      EXPECT_NEAR(slam::wrap_angle(nearest.pose.heading_rad - std::atan2(along.y(), along.x())), 0.0, 0.02)
          << i;
    }
    for (std::size_t i = 1; i < path.size(); ++i) {
      for (const slam::Control& control : path[i].controls) {
        EXPECT_NEAR(control.v_mps, 1.0, 1e-12);
        EXPECT_LT(std::abs(control.w_radps), 3.0) << "a curve of less than a third of a metre";
      }
    }
    const Eigen::Vector2d& last = closed ? points.front() : points.back();
    EXPECT_NEAR(path.back().pose.x_m, last.x(), 1e-9);
    EXPECT_NEAR(path.back().pose.y_m, last.y(), 1e-9);
    if (closed) {
      EXPECT_NEAR(slam::wrap_angle(path.back().pose.heading_rad - path.front().pose.heading_rad), 0.0, 1e-9);
    }
  }
  EXPECT_THROW(drive_spline({{{0.0, 0.0}, {0.0, 0.0}}, false, 1.0, 0.1, 0.0}), std::invalid_argument);
  EXPECT_THROW(drive_spline({{{0.0, 0.0}}, false, 1.0, 0.1, 0.0}), std::invalid_argument);
}

// Law: at each time the robot is where it was recorded, whatever it did: ahead, back, on the spot, to the
// side. Mutation: sideways() without its last turn.
TEST(Recorded, IsWhereItWasRecorded) {
  std::vector<TimedPose> poses = {{100.0, {}},
                                  {101.0, {0.0, 0.0, 1.0}},
                                  {102.0, {0.0, 0.0, 1.0}},
                                  {103.0, {-0.5, -0.5, 1.0}},
                                  {104.0, {-0.5, 0.5, 0.0}},
                                  {105.0, {-0.5, 1.5, 0.0}}};
  slam::RandomStream random(12, slam::Stream::kWorld);
  for (int i = 6; i < 100; ++i) {
    const Pose& last = poses.back().pose;
    poses.push_back({100.0 + i,
                     {last.x_m + random.normal(), last.y_m + random.normal(),
                      slam::wrap_angle(last.heading_rad + random.normal())}});
  }
  const GroundTruth path = drive_recorded(poses, 0.5, 0.0);
  ASSERT_EQ(path.size(), 2 * poses.size() - 1);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(path[2 * i].stamp_ns, static_cast<std::int64_t>(i) * 1'000'000'000);
    EXPECT_TRUE(near(slam::boxminus(path[2 * i].pose, poses[i].pose), Eigen::Vector3d::Zero().eval(), 1e-8))
        << i;
  }
  EXPECT_THROW(drive_recorded({{1.0, {}}, {1.0, {}}}, 0.5, 0.0), std::invalid_argument);
}

std::vector<TimedPose> poses_in(const std::string& text) {
  const ScenarioFolder folder;
  return read_trajectory(folder.write("trajectory.txt", text));
}

std::string trajectory_complaint(const std::string& text) {
  return complaint_of([&] { poses_in(text); });
}

// Mutation: qx for qz in the heading.
TEST(Trajectory, IsReadInBothFormats) {
  const auto tum =
      poses_in("# a comment\n1305031098.5 1 2 3 0 0 0 1\n1305031099.5 1 2.5 3 0 0 0.70710678 0.70710678\n");
  ASSERT_EQ(tum.size(), 2U);
  EXPECT_EQ(tum[0].time_s, 1305031098.5);
  EXPECT_TRUE(near(slam::boxminus(tum[0].pose, {1.0, 2.0, 0.0}), Eigen::Vector3d::Zero().eval(), 1e-12));
  EXPECT_NEAR(tum[1].pose.heading_rad, 0.5 * std::numbers::pi, 1e-7);
  const auto own = poses_in("t_s,x_m,y_m,theta_rad\n0,1,2,0.25\r\n1,1,2,-3\n");
  EXPECT_EQ(own[0].pose.heading_rad, 0.25);
  EXPECT_EQ(own[1].pose.heading_rad, -3.0);
}

TEST(Trajectory, SaysWhereItIsWrong) {
  using testing::HasSubstr;
  EXPECT_THAT(trajectory_complaint("0 0 0 0 0 0 0 1\n1 0 0 0 0 0 1\n"),
              HasSubstr("trajectory.txt:2: expected 8 numbers"));
  EXPECT_THAT(trajectory_complaint("0 0 0 0 0 0 0 1\n1 0 x 0 0 0 0 1\n"),
              HasSubstr(":2: expected 8 finite numbers"));
  EXPECT_THAT(trajectory_complaint("0 0 0 0 0 0 0 1\n0 0 0 0 0 0 0 1\n"),
              HasSubstr(":2: expected a time after"));
  EXPECT_THAT(trajectory_complaint("0 0 0 0 0 0 0 2\n"), HasSubstr(":1: expected a unit quaternion"));
  EXPECT_THAT(trajectory_complaint("0 0 0 0 0 0 0 1\n"), HasSubstr("two poses"));
  EXPECT_THAT(trajectory_complaint("t_s,x_m,y_m,theta_rad\n0,1,2,nan\n"), HasSubstr(":2: expected 4 finite"));
  EXPECT_THROW(read_trajectory("/nowhere/at_all.txt"), std::runtime_error);
}

}  // namespace
}  // namespace stereobench::worlds
