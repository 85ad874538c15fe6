#include <cmath>
#include <span>

#include <fmt/format.h>

#include "vision/palette.h"
#include "worlds/scenario/generator.h"
#include "worlds/scenario/scenario_parts.h"

namespace stereobench::worlds {
namespace {

constexpr Interval kPlace_m = {-1e4, 1e4};
constexpr Interval kSize_m = {1e-3, 1e3};
constexpr Interval kRadius_m = {1e-3, 10.0};
constexpr Interval kTolerance_m = {0.0, 1.0};
constexpr double kMostTolerance = 0.1;  // of the usual radius
constexpr Interval kShare = {0.0, 1.0};
constexpr std::size_t kMostBalls = 254;  // identities are written into 8 bits, 0 is no ball, 255 is kept free
constexpr std::size_t kMostWalls = 10000;
constexpr std::size_t kMostFolders = 64;
constexpr std::size_t kOurMaterials = 6;  // all but a file's
constexpr std::string_view kNoFloor = "none";

Key material(std::string_view name, std::string_view says) {
  return choice(name, {kMaterialNames.begin(), kMaterialNames.begin() + kOurMaterials}, says);
}

struct TextureKeys {
  std::string_view texture;
  std::string_view material;  ///< whose place it takes
};

/// A surface is of a material, or shows a picture.
void read_surface(const YamlMap& map, const TextureKeys& keys, const std::filesystem::path& folder,
                  Material& material, SurfaceTexture& texture) {
  const auto value = map.find(keys.texture);
  if (!value) {
    material = read_choice(map, keys.material, material);
    return;
  }
  if (map.find(keys.material)) value->refuse(fmt::format("expected no {} beside it", keys.material));
  material = Material::kFile;
  texture = read_surface_texture(*value, folder);
}

/// The materials, and that there is none.
std::vector<std::string_view> floor_names() {
  std::vector<std::string_view> names(kMaterialNames.begin(), kMaterialNames.begin() + kOurMaterials);
  names.push_back(kNoFloor);
  return names;
}

/// A floor of some material, one that shows a picture, or none.
void read_floor(const YamlMap& map, const std::filesystem::path& folder, World& world) {
  const auto floor = map.find("floor");
  world.has_floor = !floor || floor->scalar() != kNoFloor;
  if (const auto tint = map.find("floor_tint_rgb"); tint && !world.has_floor)
    tint->refuse("expected none where `floor: none` leaves nothing to tint");
  if (world.has_floor || map.find("floor_texture"))
    read_surface(map, {"floor_texture", "floor"}, folder, world.floor, world.floor_texture);
  world.floor_tint_rgb = read_vector<3>(map, "floor_tint_rgb", world.floor_tint_rgb);
}

Ball read_ball(const YamlValue& value, double usual_radius_m) {
  const YamlMap map(value, ball_keys());
  Ball ball;
  ball.has_usual_radius = !map.find("radius_m");
  ball.radius_m = map.number("radius_m", usual_radius_m);
  ball.centre_m = read_vector<3>(map, "at_m");
  ball.colour = map.whole("colour");
  if (map.find("paint_rgb")) ball.paint_rgb = read_vector<3>(map, "paint_rgb");
  if (ball.centre_m.z() < ball.radius_m) {
    map.at("at_m").fail(fmt::format("expected a height of at least the radius {:g}", ball.radius_m));
  }
  return ball;
}

std::vector<Ball> read_balls(const YamlMap& world) {
  const double usual_radius_m = read_ball_radius_m(world);
  std::vector<Ball> balls;
  for (const YamlValue& value : world.list("balls")) balls.push_back(read_ball(value, usual_radius_m));
  return balls;
}

/// How large balls are made, and how exactly. Where lists of balls say another size, it is that of the first.
void read_ball_size(const YamlMap& map, World& world) {
  const double usual_radius_m = read_ball_radius_m(map);
  world.ball_radius_sd_m = map.number("ball_radius_sd_m", 0.0);
  if (world.ball_radius_sd_m > kMostTolerance * usual_radius_m)
    map.at("ball_radius_sd_m")
        .refuse(
            fmt::format("expected at most a tenth of ball_radius_m, {:g}", kMostTolerance * usual_radius_m));
  const double off_m = world.balls.empty() ? 0.0 : std::abs(world.balls.front().radius_m - usual_radius_m);
  if (off_m <= kMostRadiusSds * world.ball_radius_sd_m) world.usual_radius_m = usual_radius_m;
}

/// One line of corners is a wall from each corner to the next.
void append_walls(const YamlValue& value, const std::filesystem::path& folder, std::vector<Wall>& walls) {
  const YamlMap map(value, wall_keys());
  std::vector<Eigen::Vector2d> corners_m;
  for (const YamlValue& corner : map.list("corners_m")) {
    corners_m.push_back(read_vector<2>(corner, kPlace_m));
    const std::size_t n = corners_m.size();
    if (n > 1 && corners_m[n - 1] == corners_m[n - 2])
      corner.refuse("expected another corner than the one before");
  }
  if (map.flag("closed", false)) corners_m.push_back(corners_m.front());
  Wall wall;
  wall.height_m = map.number("height_m", wall.height_m);
  wall.tint_rgb = read_vector<3>(map, "tint_rgb", wall.tint_rgb);
  read_surface(map, {"texture", "material"}, folder, wall.material, wall.texture);
  for (std::size_t i = 0; i + 1 < corners_m.size(); ++i) {
    wall.from_m = corners_m[i];
    wall.to_m = corners_m[i + 1];
    walls.push_back(wall);
  }
}

Light read_light(const YamlValue& value) {
  const YamlMap map(value, light_keys());
  Light light;
  light.towards_light = read_vector<3>(map, "towards_light", light.towards_light);
  if (light.towards_light.norm() < 1e-6)
    map.at("towards_light").refuse("expected a direction (got a vector of length 0)");
  light.ambient = map.number("ambient", light.ambient);
  light.diffuse = map.number("diffuse", light.diffuse);
  return light;
}

TextureSearch read_texture_search(const YamlMap& world, const std::filesystem::path& folder) {
  TextureSearch search;
  for (const YamlValue& value : world.list("texture_folders")) {
    const std::filesystem::path path = std::filesystem::absolute(folder / value.text()).lexically_normal();
    if (!std::filesystem::is_directory(path)) value.fail("expected a folder that exists");
    search.folders.push_back(path.string());
  }
  search.missing = read_choice(world, "missing_texture", search.missing);
  return search;
}

}  // namespace

const KeyGroup& ball_keys() {
  static const KeyGroup keys = {
      .keys = {
          whole("colour", 0, static_cast<int>(vision::kPalette.size()) - 1, "Index into the palette.")
              .needed(),
          number("at_m", kPlace_m, "Its centre in the world: x, y, z in metres.").vector(3).needed(),
          number("radius_m", kRadius_m, "Its radius, in metres.").otherwise_as("world.ball_radius_m"),
          number("paint_rgb", kShare,
                 "Its red, green and blue under full light, where they are not the palette's.")
              .vector(3)
              .otherwise_says("the palette's colour"),
      }};
  return keys;
}

const KeyGroup& wall_keys() {
  static const KeyGroup keys = {
      .keys = {
          number("corners_m", kPlace_m, "A wall stands from each corner to the next: x, y in metres.")
              .list(2, kMostWalls, 2)
              .needed(),
          flag("closed", "Whether a wall leads from the last corner to the first.").otherwise("false"),
          number("height_m", kSize_m, "Height, in metres.").otherwise("2.5"),
          material("material", "What it is made of.").otherwise("plaster"),
          number("tint_rgb", kTint, "Factors on the material's red, green and blue.")
              .vector(3)
              .otherwise("[1, 1, 1]"),
          group("texture", surface_texture_keys(), "A picture in place of the material."),
      }};
  return keys;
}

const KeyGroup& light_keys() {
  static const KeyGroup keys = {
      .keys = {
          number("towards_light", kPlace_m, "Direction towards the light: x, y, z of any length.")
              .vector(3)
              .otherwise("[0.3, 0.2, 0.9]"),
          number("ambient", kShare, "Light that comes from everywhere.").otherwise("0.45"),
          number("diffuse", kShare, "Light that falls at a right angle.").otherwise("0.55"),
      }};
  return keys;
}

const KeyGroup& world_keys() {
  static const KeyGroup keys = {
      .keys = {
          group("generator", generator_keys(), "Makes balls and walls in place of lists of them.")
              .otherwise_says("balls"),
          number("ball_radius_m", kRadius_m, "Radius of balls that do not say theirs, in metres.")
              .otherwise("0.05"),
          number("ball_radius_sd_m", kTolerance_m,
                 "Tolerance of manufacture: standard deviation of the radii of balls that do not say theirs, "
                 "in metres; 0 is exactly known.")
              .otherwise("0"),
          group("balls", ball_keys(), "The landmarks; a ball's place in the list is its identity.")
              .list(1, kMostBalls)
              .needed_unless("generator"),
          group("walls", wall_keys(), "Upright rectangles on the floor, seen from both sides.")
              .list(0, kMostWalls),
          group("meshes", mesh_keys(), "Things from mesh files, boxes and balls that are no landmarks.")
              .list(0, kMostWalls),
          group("mesh_limits", mesh_limit_keys(), "What a mesh file may cost."),
          text("texture_folders",
               "Folders, relative to the scenario's, in which textures of mesh files may also lie.")
              .list(1, kMostFolders)
              .otherwise_says("beside the mesh file and in its ../materials/textures alone"),
          choice("missing_texture", {"error", "grey"},
                 "What becomes of a mesh whose texture is nowhere: an error, or grey in its place.")
              .otherwise("error"),
          choice("floor", floor_names(), "What the floor is made of; none: nothing is seen in its place.")
              .otherwise("tiles"),
          number("floor_tint_rgb", kTint, "Factors on the floor's red, green and blue.")
              .vector(3)
              .otherwise("[1, 1, 1]"),
          group("floor_texture", surface_texture_keys(), "A picture in place of `floor`."),
          group("light", light_keys(), "Sunlight without shadows."),
          number("sky_rgb", kShare, "Colour of what is nothing: red, green, blue.")
              .vector(3)
              .otherwise("[0.75, 0.78, 0.8]"),
      }};
  return keys;
}

double read_ball_radius_m(const YamlMap& world) {
  return world.number("ball_radius_m", Ball{}.radius_m);
}

World read_world(const YamlMap& map, const std::filesystem::path& folder) {
  World world;
  if (const auto generator = map.find("generator")) {
    if (map.find("balls") || map.find("walls"))
      generator->refuse("expected no lists of balls and walls beside it: it makes them");
  } else {
    world.balls = read_balls(map);
  }
  read_ball_size(map, world);
  for (const YamlValue& wall : map.list("walls")) append_walls(wall, folder, world.walls);
  for (const YamlValue& mesh : map.list("meshes"))
    world.meshes.push_back(read_mesh(mesh, folder, world.balls));
  if (const auto limits = map.find("mesh_limits")) world.mesh_limits = read_mesh_limits(*limits);
  world.texture_search = read_texture_search(map, folder);
  read_floor(map, folder, world);
  if (const auto light = map.find("light")) world.light = read_light(*light);
  world.sky_rgb = read_vector<3>(map, "sky_rgb", world.sky_rgb);
  return world;
}

}  // namespace stereobench::worlds
