// The scenarios in assets/scenarios keep what their comments promise.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "slam/measurement.h"
#include "slam/motion.h"
#include "worlds/oracle.h"
#include "worlds/path.h"
#include "worlds/scenario.h"

namespace stereobench::worlds {
namespace {

Scenario shipped(const std::string& name) {
  return read_scenario(std::string(STEREOBENCH_SOURCE_DIR) + "/assets/scenarios/" + name + ".yaml");
}

/// A ball as an eye has it: a disc in the image that holds the true outline. Written anew here, in the plane
/// and for level cameras only, so that a fault of vision or of the renderer cannot hide in it.
struct Disc {
  double u_px = 0.0;
  double v_px = 0.0;
  double radius_px = 0.0;
  double forward_m = 0.0;
};

Eigen::Vector2d eye_in_world(const slam::Pose& pose, double left_m) {
  return {pose.x_m - left_m * std::sin(pose.heading_rad), pose.y_m + left_m * std::cos(pose.heading_rad)};
}

std::optional<Disc> disc_of(const Ball& ball, const vision::StereoRig& rig, const slam::Pose& pose,
                            double left_m) {
  const Eigen::Vector2d away = ball.centre_m.head<2>() - eye_in_world(pose, left_m);
  const double forward_m = away.x() * std::cos(pose.heading_rad) + away.y() * std::sin(pose.heading_rad);
  const double aside_m = -away.x() * std::sin(pose.heading_rad) + away.y() * std::cos(pose.heading_rad);
  if (forward_m < 3 * ball.radius_m) return std::nullopt;
  const vision::Intrinsics& camera = rig.camera;
  const Disc disc = {camera.cx_px - camera.focal_px * aside_m / forward_m,
                     camera.cy_px - camera.focal_px * (ball.centre_m.z() - rig.height_m) / forward_m,
                     camera.focal_px * ball.radius_m / forward_m * 1.08 + 2.0, forward_m};
  const bool inside = disc.u_px > disc.radius_px && disc.u_px < camera.width_px - disc.radius_px &&
                      disc.v_px > disc.radius_px && disc.v_px < camera.height_px - disc.radius_px;
  return inside ? std::optional(disc) : std::nullopt;
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

bool hidden_by(const Wall& wall, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const Eigen::Vector2d along = wall.to_m - wall.from_m;
  const Eigen::Vector2d sight = to - from;
  return cross(along, from - wall.from_m) * cross(along, to - wall.from_m) < 0 &&
         cross(sight, wall.from_m - from) * cross(sight, wall.to_m - from) < 0;
}

/// Whether no wall stands between an eye and the ball's middle or either of its sides.
bool clear_of_walls(const World& world, const Ball& ball, const Eigen::Vector2d& eye) {
  const Eigen::Vector2d sight = (ball.centre_m.head<2>() - eye).normalized();
  const Eigen::Vector2d side = Eigen::Vector2d(-sight.y(), sight.x()) * ball.radius_m;
  return std::ranges::none_of(world.walls, [&](const Wall& wall) {
    return hidden_by(wall, eye, ball.centre_m.head<2>() + side) ||
           hidden_by(wall, eye, ball.centre_m.head<2>() - side);
  });
}

/// The balls that an eye sees whole: not cut by the border, not behind a wall, not touched by a nearer ball's
/// disc.
std::vector<bool> whole_in_eye(const Scenario& scenario, const World& world, const slam::Pose& pose,
                               double left_m) {
  std::vector<std::optional<Disc>> discs;
  for (const Ball& ball : world.balls) {
    const bool clear = clear_of_walls(world, ball, eye_in_world(pose, left_m));
    discs.push_back(clear ? disc_of(ball, scenario.rig, pose, left_m) : std::nullopt);
  }
  std::vector<bool> whole;
  for (const auto& disc : discs) {
    whole.push_back(disc && std::ranges::none_of(discs, [&](const auto& other) {
                      return other && other->forward_m < disc->forward_m &&
                             std::hypot(other->u_px - disc->u_px, other->v_px - disc->v_px) <
                                 other->radius_px + disc->radius_px;
                    }));
  }
  return whole;
}

/// What a whole drive sees of a world.
struct Views {
  std::vector<int> balls_in_view;  ///< for each step: whole in both eyes within the distance
  std::vector<int> steps_seen;     ///< for each ball
  double nearest_m = 1e9;
};

Views views_of(const Scenario& scenario, const World& world, double within_m) {
  Views views;
  views.steps_seen.resize(world.balls.size());
  for (const PathStep& step : scenario.path) {
    const auto left = whole_in_eye(scenario, world, step.pose, scenario.rig.baseline_m / 2);
    const auto right = whole_in_eye(scenario, world, step.pose, -scenario.rig.baseline_m / 2);
    int count = 0;
    for (std::size_t i = 0; i < world.balls.size(); ++i) {
      const double range_m = slam::predict_sighting(step.pose, world.balls[i].centre_m.head<2>()).x();
      if (!left[i] || !right[i] || range_m > within_m) continue;
      ++count;
      ++views.steps_seen[i];
      views.nearest_m = std::min(views.nearest_m, range_m);
    }
    views.balls_in_view.push_back(count);
  }
  return views;
}

/// The least clearance between the drive and any ball's surface.
double clearance_m(const Scenario& scenario, const World& world) {
  double least_m = 1e9;
  for (const PathStep& step : scenario.path) {
    for (const Ball& ball : world.balls) {
      least_m =
          std::min(least_m, slam::predict_sighting(step.pose, ball.centre_m.head<2>()).x() - ball.radius_m);
    }
  }
  return least_m;
}

/// Rms distance of dead reckoning from the truth, the mean over seeds.
double dead_reckoning_rms_m(const Scenario& scenario, std::uint64_t seeds) {
  double sum_m = 0.0;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    slam::RandomStream noise(seed, slam::Stream::kOdometry);
    slam::Pose pose = scenario.path.front().pose;
    double squares = 0.0;
    for (const PathStep& step : scenario.path) {
      for (const slam::Control& control : step.controls) {
        pose = slam::advance(pose, slam::perturb(control, scenario.odometry_noise, noise));
      }
      squares += std::pow(pose.x_m - step.pose.x_m, 2) + std::pow(pose.y_m - step.pose.y_m, 2);
    }
    sum_m += std::sqrt(squares / static_cast<double>(scenario.path.size()));
  }
  return sum_m / static_cast<double>(seeds);
}

TEST(BallCircle, IsThePapersScenarioOne) {
  const Scenario scenario = shipped("ball_circle");
  EXPECT_EQ(scenario.world.balls.size(), 18U);
  EXPECT_EQ(scenario.path.size(), 73U);
  EXPECT_EQ(scenario.path[36].stamp_ns, 72000000000);
  EXPECT_EQ(scenario.rig.camera.width_px, 1024);
  EXPECT_EQ(scenario.rig.camera.height_px, 768);
  EXPECT_EQ(scenario.seeds.size(), 10U);
  for (const PathStep& step : scenario.path) {
    EXPECT_NEAR(std::hypot(step.pose.x_m, step.pose.y_m - 1), 1.0, 1e-12);
  }
  const slam::Control control = scenario.path[1].controls.at(0);
  EXPECT_NEAR(control.v_mps, std::numbers::pi / 36, 1e-16);
  EXPECT_NEAR(control.w_radps, std::numbers::pi / 36, 1e-16);
}

// Catches: a ball moved behind another, off the image or onto the robot's way.
TEST(BallCircle, ShowsEachBallAndTwoAtATimeForEverySeed) {
  const Scenario scenario = shipped("ball_circle");
  for (const std::uint64_t seed : scenario.seeds) {
    const World world = world_for_seed(scenario, seed);
    const Views views = views_of(scenario, world, 4.0);
    EXPECT_GE(std::ranges::min(views.balls_in_view), 1) << seed;
    EXPECT_GE(std::ranges::count_if(views.balls_in_view, [](int n) { return n >= 2; }), 69) << seed;
    EXPECT_GE(std::ranges::min(views.steps_seen), 8) << seed;
    EXPECT_GT(views.nearest_m, 0.6) << seed;
    EXPECT_GT(clearance_m(scenario, world), 0.3) << seed;
  }
}

TEST(BallCircle, LeavesDeadReckoningClearlyOff) {
  const double rms_m = dead_reckoning_rms_m(shipped("ball_circle"), 100);
  EXPECT_GT(rms_m, 0.15);
  EXPECT_LT(rms_m, 0.35);
}

TEST(Corridor, IsALapAroundTheBuildingAndSomeMore) {
  const Scenario scenario = shipped("corridor");
  EXPECT_GE(scenario.world.balls.size(), 40U);
  EXPECT_LE(scenario.path.size(), 300U);
  EXPECT_NEAR(length_m(scenario.path), 147.74, 0.01);
  double nearest_m = 1e9;
  const Eigen::Vector2d start = {scenario.path.front().pose.x_m, scenario.path.front().pose.y_m};
  for (std::size_t k = 200; k < scenario.path.size(); ++k) {
    nearest_m = std::min(nearest_m, slam::predict_sighting(scenario.path[k].pose, start).x());
  }
  EXPECT_LT(nearest_m, 0.25) << "the loop closes";
  const slam::Pose& end = scenario.path.back().pose;
  EXPECT_NEAR(end.x_m - start.x(), 10.0, 1e-6);
  EXPECT_NEAR(end.y_m, start.y(), 1e-6);
}

// The reader refuses less than 10 m; this one does not ask the reader.
TEST(Corridor, ReusesColoursButNeverTwiceWithinTenMetres) {
  const Scenario scenario = shipped("corridor");
  EXPECT_EQ(scenario.identity, Identity::kColourClass);
  for (const std::uint64_t seed : scenario.seeds) {
    const World world = world_for_seed(scenario, seed);
    for (std::size_t i = 0; i < world.balls.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const double distance_m = (world.balls[i].centre_m - world.balls[j].centre_m).norm();
        EXPECT_TRUE(world.balls[i].colour != world.balls[j].colour || distance_m >= 10.0) << i << " " << j;
      }
    }
  }
}

TEST(Corridor, HasAtLeastFortyBallsBesideDoors) {
  const Scenario scenario = shipped("corridor");
  const auto beside_a_door = [&](const Ball& ball) {
    return std::ranges::any_of(scenario.world.meshes, [&](const MeshInstance& door) {
      return (door.position_m - ball.centre_m).head<2>().norm() < 1.1;
    });
  };
  EXPECT_GE(std::ranges::count_if(scenario.world.balls, beside_a_door), 40);
}

// Catches: a ball behind a corner, a stretch or a turn where the robot would be blind.
TEST(Corridor, ShowsEachBallAndTwoAtATimeForEverySeed) {
  const Scenario scenario = shipped("corridor");
  for (const std::uint64_t seed : scenario.seeds) {
    const World world = world_for_seed(scenario, seed);
    const Views views = views_of(scenario, world, 8.0);
    EXPECT_GE(std::ranges::min(views.balls_in_view), 1) << seed;
    EXPECT_LE(std::ranges::max(views.balls_in_view), 7) << seed;
    EXPECT_GE(std::ranges::count_if(views.balls_in_view, [](int n) { return n >= 2; }), 290) << seed;
    const Views near = views_of(scenario, world, 6.0);
    EXPECT_GE(std::ranges::min(near.steps_seen), 3) << seed;
    EXPECT_GT(near.nearest_m, 0.7) << seed;
    EXPECT_GT(clearance_m(scenario, world), 0.5) << seed;
  }
}

// Catches: walls that hide nothing. The inner block's far side must not be seen through it.
TEST(Corridor, HidesBallsBehindTheInnerBlock) {
  Scenario scenario = shipped("corridor");
  const Views with_walls = views_of(scenario, scenario.world, 60.0);
  World open = scenario.world;
  open.walls.clear();
  const Views without_walls = views_of(scenario, open, 60.0);
  int more = 0;
  for (std::size_t k = 0; k < scenario.path.size(); ++k) {
    if (without_walls.balls_in_view[k] > with_walls.balls_in_view[k]) ++more;
  }
  EXPECT_GT(more, 200);
}

TEST(Corridor, LeavesDeadReckoningMetresOff) {
  const double rms_m = dead_reckoning_rms_m(shipped("corridor"), 100);
  EXPECT_GT(rms_m, 4.0);
  EXPECT_LT(rms_m, 8.0);
}

TEST(OpenField, IsThePapersSimulation) {
  const Scenario scenario = shipped("open_field");
  EXPECT_EQ(scenario.world.balls.size(), 40U);
  EXPECT_NEAR(length_m(scenario.path), 156.0, 0.001);
  EXPECT_EQ(scenario.path[1].stamp_ns, 500000000);
  EXPECT_EQ(scenario.odometry_noise.v_constant_mps, 0.02);
  EXPECT_DOUBLE_EQ(scenario.odometry_noise.w_constant_radps, 0.2 * std::numbers::pi / 180);
  EXPECT_EQ(scenario.oracle.range_sd_m, 0.3);
  EXPECT_DOUBLE_EQ(scenario.oracle.bearing_sd_rad, 3 * std::numbers::pi / 180);
  EXPECT_EQ(scenario.oracle.max_range_m, 30.0);
  EXPECT_DOUBLE_EQ(scenario.oracle.field_of_view_rad, std::numbers::pi);
  EXPECT_EQ(scenario.seeds.size(), 100U);
  EXPECT_GT(clearance_m(scenario, scenario.world), 1.0);
  for (const Ball& ball : scenario.world.balls)
    EXPECT_LE(ball.centre_m.head<2>().cwiseAbs().maxCoeff(), 50.0);
}

TEST(OpenField, ShowsThirtySevenLandmarksAndSomeAtEachStep) {
  const Scenario scenario = shipped("open_field");
  OracleSensor exact = scenario.oracle;
  exact.range_sd_m = exact.bearing_sd_rad = 0.0;
  slam::RandomStream noise(0, slam::Stream::kOracle);
  std::set<int> seen;
  for (const PathStep& step : scenario.path) {
    const auto sightings = sense(scenario.world, step.pose, exact, scenario.identity, noise).sightings;
    EXPECT_GE(sightings.size(), 1U);
    for (const auto& sighting : sightings) seen.insert(sighting.landmark_id);
  }
  EXPECT_EQ(seen.size(), 37U);
}

}  // namespace
}  // namespace stereobench::worlds
