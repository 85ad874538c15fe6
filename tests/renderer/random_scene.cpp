#include "tests/renderer/random_scene.h"

#include <cmath>

namespace stereobench::renderer::test {

double between(slam::RandomStream& random, double low, double high) {
  return low + (high - low) * random.uniform();
}

vision::StereoRig small_rig() {
  vision::StereoRig rig;
  rig.intrinsics = {.width_px = 400, .height_px = 300, .focal_px = 347.3, .cx_px = 190.7, .cy_px = 161.2};
  rig.pitch_down_rad = 0.07;
  return rig;
}

worlds::World random_room(std::uint64_t seed) {
  using worlds::Material;
  slam::RandomStream random(seed, slam::Stream::kWorld);
  worlds::World world;
  const auto corner = [&](double east, double north) {
    return Eigen::Vector2d(east + between(random, -0.5, 0.5), north + between(random, -0.5, 0.5));
  };
  const Eigen::Vector2d corners[] = {corner(-5, -5), corner(5, -5), corner(5, 5), corner(-5, 5)};
  const Material materials[] = {Material::kPlaster, Material::kBricks, Material::kWood, Material::kPlain};
  for (std::size_t i = 0; i < 4; ++i)
    world.walls.push_back({corners[i], corners[(i + 1) % 4], 2.5, materials[i]});
  world.walls.push_back({corner(2, -1), corner(2, 1), 0.4, Material::kWood});
  for (int k = 0; k < 18; ++k) {
    const double angle = between(random, -M_PI, M_PI);
    const double away_m = between(random, 0.9, 4.4);
    const double radius_m = between(random, 0.03, 0.25);
    world.balls.push_back(
        {{away_m * std::cos(angle), away_m * std::sin(angle), between(random, radius_m, 0.8)}, radius_m, k});
  }
  return world;
}

slam::Pose random_pose(std::uint64_t seed) {
  slam::RandomStream random(seed, slam::Stream::kWorld, 1);
  return {between(random, -0.3, 0.3), between(random, -0.3, 0.3), between(random, -M_PI, M_PI)};
}

worlds::World flat_sky(std::vector<worlds::Ball> balls) {
  worlds::World world;
  world.balls = std::move(balls);
  world.floor = worlds::Material::kPlain;
  world.light = {.towards_light = {0.0, 0.0, 1.0}, .ambient = 1.0, .diffuse = 0.0};
  world.sky_rgb = {0.0, 0.0, 0.0};
  return world;
}

vision::StereoRig rig_looking_up() {
  vision::StereoRig rig = small_rig();
  rig.pitch_down_rad = -0.9;
  return rig;
}

}  // namespace stereobench::renderer::test
