#include "worlds/generate/calibration_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "slam/math/angles.h"
#include "slam/math/elementary.h"
#include "slam/math/random.h"
#include "slam/models/motion.h"
#include "vision/camera/rig.h"
#include "vision/palette.h"

namespace stereobench::worlds {
namespace {

constexpr int kBallsPerLook = 10;
constexpr int kSceneTries = 100;
constexpr double kFullRow = 0.6;         // of a picture's width, which a ball and its shift may fill
constexpr double kLeastGap = 2.2;        // radii between two balls' centres
constexpr std::size_t kMostBalls = 254;  // of a world
constexpr int kWalls = 6;
constexpr double kWallDistance = 1.2;  // of the farthest ball's depth
constexpr double kWallHeight_m = 6.0;

class SceneSampler {
 public:
  explicit SceneSampler(std::uint64_t seed) : stream_(seed, slam::Stream::kCalibrationScene) {}

  double between(double low, double high) { return low + (high - low) * stream_.uniform(); }
  int below(int count) { return static_cast<int>(stream_.uniform() * count); }

 private:
  slam::RandomStream stream_;
};

int looks_around(const vision::Intrinsics& camera) {
  const double half_view = slam::arc_tangent(0.5 * camera.width_px, camera.focal_px);
  return std::max(1, static_cast<int>(slam::kPi / half_view));
}

/// A place whose centre both cameras have in their pictures.
/// @return in the robot's frame; empty where the draw gave none
std::optional<Eigen::Vector3d> place_in_view(const vision::StereoRig& rig, const CalibrationDepths& depths,
                                             double radius_m, SceneSampler& draws) {
  const double share = draws.between(0.0, 1.0);
  const double depth =
      depths.nearest_m * slam::exponential(share * slam::logarithm(depths.farthest_m / depths.nearest_m));
  const double u = draws.between(-0.5, rig.intrinsics.width_px - 0.5);
  const double v = draws.between(-0.5, rig.intrinsics.height_px - 0.5);
  Eigen::Vector3d in_camera = depth * vision::pixel_ray(rig.intrinsics, {u, v});
  const Eigen::Vector3d in_right = vision::camera_point(rig, in_camera, vision::Side::kRight);
  in_camera.y() /= rig.distortion.pixel_aspect;
  const Eigen::Vector3d in_robot = vision::robot_from_camera(rig) * in_camera;
  if (!vision::project_if_visible(rig.intrinsics, in_right) || in_robot.z() < radius_m) return std::nullopt;
  return in_robot;
}

Ball ball_at(const slam::Pose& robot, const Eigen::Vector3d& in_robot, double radius_m, int colour) {
  const auto [s, c] = slam::sine_cosine(robot.heading_rad);
  return {{c * in_robot.x() - s * in_robot.y(), s * in_robot.x() + c * in_robot.y(), in_robot.z()},
          radius_m,
          colour,
          {},
          true};
}

bool has_room(const Ball& ball, const std::vector<Ball>& others) {
  return std::ranges::none_of(others, [&](const Ball& other) {
    return (other.centre_m - ball.centre_m).norm() < kLeastGap * ball.radius_m;
  });
}

void add_balls(const Scenario& scenario, const CalibrationDepths& depths, const slam::Pose& robot,
               double radius_m, SceneSampler& draws, std::vector<Ball>& balls) {
  int missing = kBallsPerLook;
  for (int tries = 0; tries < kSceneTries && missing > 0 && balls.size() < kMostBalls; ++tries) {
    const auto place = place_in_view(scenario.rig, depths, radius_m, draws);
    const int colour = draws.below(static_cast<int>(vision::kPalette.size()));
    if (!place) continue;
    const Ball ball = ball_at(robot, *place, radius_m, colour);
    if (!has_room(ball, balls)) continue;
    balls.push_back(ball);
    --missing;
  }
}

Material any_material(bool plain, SceneSampler& draws) {
  constexpr std::array<Material, 5> kAny = {Material::kPlain, Material::kTiles, Material::kPlaster,
                                            Material::kBricks, Material::kWood};
  const Material drawn = kAny[static_cast<std::size_t>(draws.below(static_cast<int>(kAny.size())))];
  return plain ? Material::kPlain : drawn;
}

Light any_light(SceneSampler& draws) {
  Light light;
  light.towards_light = {draws.between(-1.0, 1.0), draws.between(-1.0, 1.0), draws.between(0.3, 1.0)};
  light.ambient = draws.between(0.3, 0.6);
  light.diffuse = 1.0 - light.ambient;
  return light;
}

std::vector<Wall> walls_around(double distance_m, bool plain, SceneSampler& draws) {
  std::vector<Wall> walls;
  const auto corner = [&](int i) -> Eigen::Vector2d {
    const auto [s, c] = slam::sine_cosine(2.0 * slam::kPi * i / kWalls);
    return distance_m * Eigen::Vector2d(c, s);
  };
  for (int i = 0; i < kWalls; ++i)
    walls.push_back({corner(i), corner((i + 1) % kWalls), kWallHeight_m, any_material(plain, draws)});
  return walls;
}

}  // namespace

CalibrationDepths measurable_depths(const vision::StereoRig& rig, double ball_radius_m,
                                    double smallest_radius_px) {
  const vision::Intrinsics& camera = rig.intrinsics;
  const double nearest =
      camera.focal_px * (2.0 * ball_radius_m + rig.baseline_m) / (kFullRow * camera.width_px);
  return {std::max(nearest, 2.0 * ball_radius_m), camera.focal_px * ball_radius_m / smallest_radius_px};
}

Scenario calibration_scene(const Scenario& scenario, const CalibrationSceneSettings& settings,
                           std::uint64_t seed) {
  SceneSampler draws(seed);
  Scenario made = scenario;
  made.shutter = {};
  made.identity = Identity::kColourClass;
  made.colour_spacing_m = 0.0;
  made.placement_jitter_m = 0.0;
  made.world = {};
  made.world.usual_radius_m = scenario.world.ball_radius_m();
  made.world.ball_radius_sd_m = scenario.world.ball_radius_sd_m;
  made.world.sky_rgb = scenario.world.sky_rgb;
  made.world.light = any_light(draws);
  made.world.floor = any_material(settings.plain, draws);
  made.world.walls = walls_around(kWallDistance * settings.depths.farthest_m, settings.plain, draws);
  made.path.clear();
  const double radius_m = scenario.world.ball_radius_m();
  const int looks = looks_around(scenario.rig.intrinsics);
  for (int look = 0; look < looks; ++look) {
    const double heading = slam::wrap_angle(2.0 * slam::kPi * look / looks);
    made.path.push_back({.stamp_ns = look * std::int64_t{1'000'000'000}, .pose = {0.0, 0.0, heading}});
    add_balls(scenario, settings.depths, made.path.back().pose, radius_m, draws, made.world.balls);
  }
  return made;
}

}  // namespace stereobench::worlds
