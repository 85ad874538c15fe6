#include <array>
#include <numbers>
#include <span>

#include <fmt/format.h>

#include "vision/palette.h"
#include "worlds/scenario_parts.h"

namespace stereobench::worlds {
namespace {

constexpr Interval kPlace_m = {-1e4, 1e4};
constexpr Interval kSize_m = {1e-3, 1e3};
constexpr Interval kShare = {0.0, 1.0};
constexpr std::size_t kMostBalls = 254;  // identities are written into 8 bits, 0 is no ball, 255 is kept free
constexpr std::size_t kMostWalls = 10000;

Material read_material(const YamlMap& map, std::string_view key, Material fallback) {
  const auto value = map.find(key);
  return value ? static_cast<Material>(value->choice(std::span(kMaterialNames).first(6))) : fallback;
}

/// Factors on a material's colours; none where the key is left out.
Eigen::Vector3d read_tint(const YamlMap& map, std::string_view key) {
  const auto value = map.find(key);
  return value ? read_vector<3>(*value, kTint) : Eigen::Vector3d(Eigen::Vector3d::Ones());
}

struct TextureKeys {
  std::string_view texture;
  std::string_view material;  ///< whose place it takes
};

void read_texture(const YamlMap& map, const TextureKeys& keys, const std::filesystem::path& folder,
                  Material& material, SurfaceTexture& texture) {
  const auto value = map.find(keys.texture);
  if (!value) return;
  if (map.find(keys.material)) value->refuse(fmt::format("expected no {} beside it", keys.material));
  material = Material::kFile;
  texture = read_surface_texture(*value, folder);
}

Ball read_ball(const YamlValue& value, double usual_radius_m) {
  const YamlMap map(value, {"colour", "at_m", "radius_m", "paint_rgb"});
  Ball ball;
  ball.radius_m = map.number("radius_m", {1e-3, 10.0}, usual_radius_m);
  ball.centre_m = read_vector<3>(map.at("at_m"), kPlace_m);
  ball.colour = map.at("colour").integer(0, static_cast<int>(vision::kPalette.size()) - 1);
  if (const auto paint = map.find("paint_rgb")) ball.paint_rgb = read_vector<3>(*paint, kShare);
  if (ball.centre_m.z() < ball.radius_m) {
    map.at("at_m").fail(fmt::format("expected a height of at least the radius {:g}", ball.radius_m));
  }
  return ball;
}

std::vector<Ball> read_balls(const YamlMap& world) {
  const double usual_radius_m = read_ball_radius_m(world);
  std::vector<Ball> balls;
  for (const YamlValue& value : world.at("balls").list(1, kMostBalls)) {
    balls.push_back(read_ball(value, usual_radius_m));
  }
  return balls;
}

/// One line of corners is a wall from each corner to the next.
void append_walls(const YamlValue& value, const std::filesystem::path& folder, std::vector<Wall>& walls) {
  const YamlMap map(value, {"corners_m", "closed", "height_m", "material", "tint_rgb", "texture"});
  std::vector<Eigen::Vector2d> corners_m;
  for (const YamlValue& corner : map.at("corners_m").list(2, kMostWalls)) {
    corners_m.push_back(read_vector<2>(corner, kPlace_m));
    const std::size_t n = corners_m.size();
    if (n > 1 && corners_m[n - 1] == corners_m[n - 2])
      corner.refuse("expected another corner than the one before");
  }
  const auto closed = map.find("closed");
  if (closed && closed->flag()) corners_m.push_back(corners_m.front());
  Wall wall{.height_m = map.number("height_m", kSize_m, 2.5),
            .material = read_material(map, "material", Material::kPlaster),
            .tint_rgb = read_tint(map, "tint_rgb")};
  read_texture(map, {"texture", "material"}, folder, wall.material, wall.texture);
  for (std::size_t i = 0; i + 1 < corners_m.size(); ++i) {
    wall.from_m = corners_m[i];
    wall.to_m = corners_m[i + 1];
    walls.push_back(wall);
  }
}

Light read_light(const YamlValue& value) {
  const YamlMap map(value, {"towards_light", "ambient", "diffuse"});
  Light light;
  if (const auto towards = map.find("towards_light")) {
    light.towards_light = read_vector<3>(*towards, kPlace_m);
    if (light.towards_light.norm() < 1e-6) towards->refuse("expected a direction (got a vector of length 0)");
  }
  light.ambient = map.number("ambient", kShare, light.ambient);
  light.diffuse = map.number("diffuse", kShare, light.diffuse);
  return light;
}

}  // namespace

double read_ball_radius_m(const YamlMap& world) {
  return world.number("ball_radius_m", {1e-3, 10.0}, 0.05);
}

World read_world(const YamlMap& map, const std::filesystem::path& folder) {
  World world;
  if (const auto generator = map.find("generator")) {
    if (map.find("balls") || map.find("walls"))
      generator->refuse("expected no lists of balls and walls beside it: it makes them");
  } else {
    world.balls = read_balls(map);
  }
  if (const auto walls = map.find("walls")) {
    for (const YamlValue& wall : walls->list(0, kMostWalls)) append_walls(wall, folder, world.walls);
  }
  if (const auto meshes = map.find("meshes")) {
    for (const YamlValue& mesh : meshes->list(0, kMostWalls))
      world.meshes.push_back(read_mesh(mesh, folder, world.balls));
  }
  if (const auto limits = map.find("mesh_limits")) world.mesh_limits = read_mesh_limits(*limits);
  world.floor = read_material(map, "floor", world.floor);
  read_texture(map, {"floor_texture", "floor"}, folder, world.floor, world.floor_texture);
  world.floor_tint_rgb = read_tint(map, "floor_tint_rgb");
  if (const auto light = map.find("light")) world.light = read_light(*light);
  if (const auto sky = map.find("sky_rgb")) world.sky_rgb = read_vector<3>(*sky, kShare);
  return world;
}

}  // namespace stereobench::worlds
