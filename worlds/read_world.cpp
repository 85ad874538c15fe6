#include <array>
#include <numbers>

#include <fmt/format.h>

#include "vision/palette.h"
#include "worlds/scenario_parts.h"

namespace stereobench::worlds {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr Interval kPlace_m = {-1e4, 1e4};
constexpr Interval kSize_m = {1e-3, 1e3};
constexpr Interval kShare = {0.0, 1.0};
constexpr std::size_t kMostBalls = 254;  // identities are written into 8 bits, 0 is no ball, 255 is kept free
constexpr std::size_t kMostWalls = 10000;

constexpr std::array<std::string_view, 5> kMaterials = {"plain", "tiles", "plaster", "bricks", "wood"};

Material read_material(const YamlMap& map, std::string_view key, Material fallback) {
  const auto value = map.find(key);
  return value ? static_cast<Material>(value->choice(kMaterials)) : fallback;
}

Ball read_ball(const YamlValue& value, double usual_radius_m) {
  const YamlMap map(value, {"colour", "at_m", "radius_m"});
  Ball ball;
  ball.radius_m = map.number("radius_m", {1e-3, 10.0}, usual_radius_m);
  ball.centre_m = read_vector<3>(map.at("at_m"), kPlace_m);
  ball.colour = map.at("colour").integer(0, static_cast<int>(vision::kPalette.size()) - 1);
  if (ball.centre_m.z() < ball.radius_m) {
    map.at("at_m").fail(fmt::format("expected a height of at least the radius {:g}", ball.radius_m));
  }
  return ball;
}

std::vector<Ball> read_balls(const YamlMap& world) {
  const double usual_radius_m = world.number("ball_radius_m", {1e-3, 10.0}, 0.05);
  std::vector<Ball> balls;
  for (const YamlValue& value : world.at("balls").list(1, kMostBalls)) {
    balls.push_back(read_ball(value, usual_radius_m));
  }
  return balls;
}

/// One line of corners is a wall from each corner to the next.
void append_walls(const YamlValue& value, std::vector<Wall>& walls) {
  const YamlMap map(value, {"corners_m", "closed", "height_m", "material"});
  std::vector<Eigen::Vector2d> corners_m;
  for (const YamlValue& corner : map.at("corners_m").list(2, kMostWalls)) {
    corners_m.push_back(read_vector<2>(corner, kPlace_m));
    const std::size_t n = corners_m.size();
    if (n > 1 && corners_m[n - 1] == corners_m[n - 2])
      corner.refuse("expected another corner than the one before");
  }
  const auto closed = map.find("closed");
  if (closed && closed->flag()) corners_m.push_back(corners_m.front());
  for (std::size_t i = 0; i + 1 < corners_m.size(); ++i) {
    walls.push_back({corners_m[i], corners_m[i + 1], map.number("height_m", kSize_m, 2.5),
                     read_material(map, "material", Material::kPlaster)});
  }
}

/// Puts a mesh of unit height between the floor and the ball that `ball` names.
void stand_under(const YamlValue& ball, const std::vector<Ball>& balls, MeshInstance& mesh) {
  mesh.carried_ball = ball.integer(0, static_cast<int>(balls.size()) - 1);
  const Ball& carried = balls[static_cast<std::size_t>(mesh.carried_ball)];
  const double height_m = carried.centre_m.z() - carried.radius_m;
  if (height_m < 1e-3) ball.fail("expected a ball above the floor");
  mesh.position_m = {carried.centre_m.x(), carried.centre_m.y(), 0.0};
  mesh.scale.z() = height_m;
}

MeshInstance read_mesh(const YamlValue& value, const std::filesystem::path& folder, const World& world) {
  const YamlMap map(value, {"file", "at_m", "under_ball", "heading_deg", "scale", "material"});
  MeshInstance mesh;
  const std::filesystem::path file =
      std::filesystem::absolute(folder / map.at("file").text()).lexically_normal();
  if (!std::filesystem::is_regular_file(file)) map.at("file").fail("expected a mesh file that exists");
  mesh.file = file.string();
  const auto at = map.find("at_m");
  const auto ball = map.find("under_ball");
  if (at.has_value() == ball.has_value()) value.refuse("expected either at_m or under_ball");
  mesh.heading_rad = map.number("heading_deg", {-360.0, 360.0}, 0.0) * kDegree;
  if (const auto scale = map.find("scale")) mesh.scale = read_vector<3>(*scale, kSize_m);
  if (at) mesh.position_m = read_vector<3>(*at, kPlace_m);
  if (ball) stand_under(*ball, world.balls, mesh);
  mesh.material = read_material(map, "material", Material::kWood);
  return mesh;
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

World read_world(const YamlMap& map, const std::filesystem::path& folder) {
  World world;
  world.balls = read_balls(map);
  if (const auto walls = map.find("walls")) {
    for (const YamlValue& wall : walls->list(0, kMostWalls)) append_walls(wall, world.walls);
  }
  if (const auto meshes = map.find("meshes")) {
    for (const YamlValue& mesh : meshes->list(0, kMostWalls))
      world.meshes.push_back(read_mesh(mesh, folder, world));
  }
  world.floor = read_material(map, "floor", world.floor);
  if (const auto light = map.find("light")) world.light = read_light(*light);
  if (const auto sky = map.find("sky_rgb")) world.sky_rgb = read_vector<3>(*sky, kShare);
  return world;
}

}  // namespace stereobench::worlds
