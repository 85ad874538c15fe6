#include "worlds/generate/randomise.h"

#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "slam/math/angles.h"
#include "slam/math/elementary.h"
#include "slam/math/random.h"
#include "vision/palette.h"
#include "worlds/generate/paint.h"
#include "worlds/generate/scattered.h"

namespace stereobench::worlds {
namespace {

constexpr int kColours = static_cast<int>(vision::kPalette.size());

constexpr double kStepsPerMetre = 1024.0 * 1024.0 * 1024.0;  // of radii: sums of so few digits are exact

void jitter(double by_m, std::uint64_t seed, World& world) {
  for (std::size_t i = 0; i < world.balls.size(); ++i) {
    slam::RandomStream draws(seed, slam::Stream::kWorld, i);
    world.balls[i].centre_m.x() += by_m * (2.0 * draws.uniform() - 1.0);
    world.balls[i].centre_m.y() += by_m * (2.0 * draws.uniform() - 1.0);
  }
  for (MeshInstance& mesh : world.meshes) {
    if (mesh.carried_ball == slam::kUnknown) continue;
    mesh.position_m.head<2>() =
        world.balls.at(static_cast<std::size_t>(mesh.carried_ball)).centre_m.head<2>();
  }
}

/// Makes the balls that have the usual radius, each with its own error; a ball stays on what it stands on.
void make_balls(std::uint64_t seed, World& world) {
  if (!(world.ball_radius_sd_m > 0.0)) return;
  for (std::size_t i = 0; i < world.balls.size(); ++i) {
    Ball& ball = world.balls[i];
    if (!ball.has_usual_radius) continue;
    slam::RandomStream draws(seed, slam::Stream::kBallRadius, i);
    double off = draws.normal();
    while (std::abs(off) > kMostRadiusSds) off = draws.normal();
    const double off_m = std::round(off * world.ball_radius_sd_m * kStepsPerMetre) / kStepsPerMetre;
    ball.radius_m += off_m;
    ball.centre_m.z() += off_m;
    ball.has_usual_radius = false;
  }
}

/// Which colour takes the place of which (Fisher and Yates): all orders are equally likely.
std::array<int, kColours> shuffled_palette(KeyedSampler& draws) {
  std::array<int, kColours> colours{};
  std::iota(colours.begin(), colours.end(), 0);
  for (int i = 0; i + 1 < kColours; ++i) {
    const int other = draws.whole(fmt::format("ball_colours.swap[{}]", i), i, kColours - 1);
    std::swap(colours[static_cast<std::size_t>(i)], colours[static_cast<std::size_t>(other)]);
  }
  return colours;
}

void recolour(const BallColours& rules, World& world, KeyedSampler& draws) {
  if (rules.shuffle) {
    const auto colours = shuffled_palette(draws);
    for (Ball& ball : world.balls) ball.colour = colours[static_cast<std::size_t>(ball.colour)];
  }
  for (std::size_t i = 0; i < world.balls.size(); ++i)
    world.balls[i].paint_rgb =
        draw_paint(draws, fmt::format("ball_colours[{}]", i), world.balls[i].colour, rules.shade, rules.tint);
}

void relight(const LightRanges& rules, Light& light, KeyedSampler& draws) {
  const auto azimuth =
      slam::sine_cosine(slam::kRadPerDegree * draws.number("light.azimuth_deg", rules.azimuth_deg));
  const auto elevation =
      slam::sine_cosine(slam::kRadPerDegree * draws.number("light.elevation_deg", rules.elevation_deg));
  light.towards_light = {elevation.cosine * azimuth.cosine, elevation.cosine * azimuth.sine, elevation.sine};
  light.ambient = draws.number("light.ambient", rules.ambient);
  light.diffuse = draws.number("light.diffuse", rules.diffuse);
}

void resurface(const Randomisation& rules, World& world, KeyedSampler& draws) {
  for (std::size_t i = 0; rules.walls && i < world.walls.size(); ++i) {
    const std::string name = fmt::format("walls[{}]", i);
    draw_surface(draws, name, *rules.walls, world.walls[i].material, world.walls[i].texture);
    world.walls[i].tint_rgb = draw_tint(draws, name, *rules.walls);
  }
  if (!rules.floor) return;
  draw_surface(draws, "floor", *rules.floor, world.floor, world.floor_texture);
  world.floor_tint_rgb = draw_tint(draws, "floor", *rules.floor);
}

}  // namespace

SeedWorld seed_world(const Scenario& scenario, std::uint64_t seed) {
  const Randomisation& rules = scenario.randomise;
  SeedWorld made{scenario.world, {}, {}};
  KeyedSampler draws(seed);
  jitter(scenario.placement_jitter_m, seed, made.world);
  make_balls(seed, made.world);
  if (rules.ball_colours) recolour(*rules.ball_colours, made.world, draws);
  resurface(rules, made.world, draws);
  if (rules.light) relight(*rules.light, made.world.light, draws);
  made.left_out = scatter(scenario, made.world, draws);
  made.draws = draws.log();
  return made;
}

}  // namespace stereobench::worlds
