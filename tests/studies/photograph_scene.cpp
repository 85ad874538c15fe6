#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "slam/math/angles.h"
#include "slam/math/random.h"
#include "tests/studies/photograph.h"

namespace stereobench::photograph {
namespace {

constexpr double kLeastRadius_px = 11.0;
constexpr int kMostBalls = 7;

const std::array<Light, 5> kPaints = {Light(0.52, 0.035, 0.03), Light(0.80, 0.21, 0.025),
                                      Light(0.80, 0.58, 0.045), Light(0.035, 0.10, 0.48),
                                      Light(0.60, 0.05, 0.27)};

class KeyedSampler {
 public:
  explicit KeyedSampler(std::uint64_t seed) : stream_(seed, slam::Stream::kWorld) {}

  double between(double low, double high) { return low + (high - low) * stream_.uniform(); }
  int below(int count) { return static_cast<int>(stream_.uniform() * count); }
  bool once_in(double times) { return stream_.uniform() * times < 1.0; }
  Light near(const Light& paint, double share) {
    return paint * Light(between(1.0 - share, 1.0 + share), between(1.0 - share, 1.0 + share),
                         between(1.0 - share, 1.0 + share));
  }

 private:
  slam::RandomStream stream_;
};

Ball ball_of(KeyedSampler& draws, const Scene& scene) {
  Ball ball;
  const double lowest_px = scene.height_px + 20.0;
  const double nearest_px = scene.horizon_px + kLeastRadius_px / scene.ball_radius;
  const double contact_px = draws.between(std::min(nearest_px, lowest_px - 1.0), lowest_px);
  ball.radius_px = scene.ball_radius * (contact_px - scene.horizon_px);
  ball.centre_px = {draws.between(-0.3 * ball.radius_px, scene.width_px + 0.3 * ball.radius_px),
                    contact_px - ball.radius_px};
  ball.colour = draws.below(static_cast<int>(kPaints.size()));
  ball.paint = draws.near(kPaints[static_cast<std::size_t>(ball.colour)], 0.08);
  ball.dress = static_cast<Dress>(draws.below(5));
  ball.second = draws.once_in(2.0) ? Light(0.75, 0.75, 0.72) : Light(0.03, 0.03, 0.03);
  ball.sheen = ball.dress == Dress::kFelt ? 0.0 : draws.between(0.0, 0.5);
  ball.sharpness = std::exp(draws.between(std::log(8.0), std::log(150.0)));
  ball.turn = (Eigen::AngleAxisd(draws.between(0.0, 2.0 * slam::kPi), Eigen::Vector3d::UnitZ()) *
               Eigen::AngleAxisd(draws.between(0.0, slam::kPi), Eigen::Vector3d::UnitX()) *
               Eigen::AngleAxisd(draws.between(0.0, 2.0 * slam::kPi), Eigen::Vector3d::UnitZ()))
                  .matrix();
  return ball;
}

/// Balls are apart, but one in five may stand before another.
void add_balls(KeyedSampler& draws, Scene& scene) {
  const int count = 2 + draws.below(kMostBalls - 1);
  for (int tries = 0; tries < 100 && static_cast<int>(scene.balls.size()) < count; ++tries) {
    const Ball ball = ball_of(draws, scene);
    const double least = draws.once_in(5.0) ? 0.5 : 1.15;
    const bool has_room = std::ranges::none_of(scene.balls, [&](const Ball& other) {
      return (other.centre_px - ball.centre_px).norm() < least * (other.radius_px + ball.radius_px);
    });
    if (has_room) scene.balls.push_back(ball);
  }
  std::ranges::sort(scene.balls, {}, &Ball::radius_px);
}

Light odd_paint(KeyedSampler& draws) {
  const double grey = draws.between(0.03, 0.6);
  if (!draws.once_in(3.0)) return draws.near(Light::Constant(grey), 0.3);
  return {draws.between(0.02, 0.7), draws.between(0.02, 0.7), draws.between(0.02, 0.7)};
}

/// Boxes on the horizon, leaves on the ground, and now and then a post before all.
void add_clutter(KeyedSampler& draws, Scene& scene) {
  const int boxes = draws.below(7);
  for (int i = 0; i < boxes; ++i)
    scene.behind.push_back(
        {{draws.between(0.0, scene.width_px), scene.horizon_px + draws.between(-60.0, 10.0)},
         {draws.between(8.0, 70.0), draws.between(8.0, 60.0)},
         draws.between(-0.1, 0.1),
         false,
         odd_paint(draws)});
  const int leaves = draws.once_in(2.0) ? draws.below(25) : 0;
  for (int i = 0; i < leaves; ++i) {
    const double size_px = draws.between(3.0, 14.0);
    const std::array<Light, 4> autumn = {Light(0.55, 0.35, 0.05), Light(0.5, 0.15, 0.03),
                                         Light(0.35, 0.05, 0.03), Light(0.25, 0.15, 0.06)};
    scene.behind.push_back(
        {{draws.between(0.0, scene.width_px), draws.between(scene.horizon_px + 30.0, scene.height_px)},
         {size_px, draws.between(0.3, 0.7) * size_px},
         draws.between(0.0, slam::kPi),
         true,
         draws.near(autumn[static_cast<std::size_t>(draws.below(4))], 0.2)});
  }
  if (draws.once_in(4.0))
    scene.before.push_back({{draws.between(0.0, scene.width_px), 0.6 * scene.height_px},
                            {draws.between(4.0, 18.0), scene.height_px},
                            draws.between(-0.15, 0.15),
                            false,
                            odd_paint(draws)});
}

Light ground_paint_of(KeyedSampler& draws, Ground ground) {
  switch (ground) {
    case Ground::kGrass:
      return draws.near({0.09, 0.17, 0.035}, 0.25);
    case Ground::kWood:
      return draws.near({0.36, 0.21, 0.10}, 0.25);
    case Ground::kGravel:
      return draws.near(Light::Constant(draws.between(0.15, 0.45)), 0.06);
    case Ground::kCloth:
      return draws.near(Light::Constant(draws.between(0.05, 0.5)), 0.3);
  }
  return Light::Zero();
}

}  // namespace

Scene scene_of(std::uint64_t seed) {
  KeyedSampler draws(seed);
  Scene scene;
  scene.seed = seed;
  scene.horizon_px = draws.between(0.02, 0.35) * scene.height_px;
  scene.ball_radius = draws.between(0.08, 0.22);
  scene.ground = static_cast<Ground>(draws.below(4));
  scene.ground_paint = ground_paint_of(draws, scene.ground);
  scene.wall_paint = odd_paint(draws);
  const double clear = draws.between(0.0, 1.0);  // 0: overcast, or indoors
  scene.sky = draws.near(Light(0.50, 0.53, 0.58) * (1.0 - 0.5 * clear), 0.05);
  scene.sun = draws.near(Light(0.95, 0.88, 0.78) * (0.1 + 0.75 * clear), 0.05);
  const double azimuth = draws.between(-slam::kPi, slam::kPi);
  const double height = draws.between(0.5, 1.3);
  scene.to_sun = {std::cos(height) * std::sin(azimuth), std::sin(height),
                  std::cos(height) * std::cos(azimuth)};
  add_balls(draws, scene);
  add_clutter(draws, scene);
  return scene;
}

Camera camera_of(std::uint64_t seed) {
  KeyedSampler draws(seed + 1'000'000);
  Camera camera;
  camera.exposure = draws.between(0.7, 1.25);
  camera.defocus_sd_px = draws.between(0.4, 1.0);
  const double angle = draws.between(0.0, slam::kPi);
  const double way_px = draws.once_in(3.0) ? draws.between(1.0, 5.0) : 0.0;
  camera.motion_px = way_px * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  camera.noise_sd_levels = draws.between(0.5, 2.5);
  camera.balance_bgr = {draws.between(0.93, 1.07), 1.0, draws.between(0.93, 1.07)};
  camera.jpeg_quality = 75 + draws.below(21);
  return camera;
}

}  // namespace stereobench::photograph
