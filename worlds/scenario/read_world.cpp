#include <cmath>

#include <fmt/format.h>

#include "vision/palette.h"
#include "worlds/scenario/generator.h"
#include "worlds/scenario/scenario_parts.h"

namespace stereobench::worlds {
namespace {

constexpr Interval kThingSize_m = {1e-3, 1e3};
constexpr Interval kRadius_m = {1e-3, 10.0};
constexpr Interval kTolerance_m = {0.0, 1.0};
constexpr double kMostTolerance = 0.1;   // of the usual radius
constexpr std::size_t kMostBalls = 254;  // identities are written into 8 bits, 0 is no ball, 255 is kept free
constexpr std::size_t kMostWalls = 10000;
constexpr std::size_t kMostFolders = 64;
constexpr std::string_view kNoFloor = "none";

Key material(std::string_view name, std::string_view says) {
  return choice(name, {kMaterialNames.begin(), kMaterialNames.begin() + kOurMaterials}, says);
}

/// The materials, and that there is none.
std::vector<std::string_view> floor_names() {
  std::vector<std::string_view> names(kMaterialNames.begin(), kMaterialNames.begin() + kOurMaterials);
  names.push_back(kNoFloor);
  return names;
}

/// How large balls are made, and how exactly. Where lists of balls say another size, it is that of the first.
void check_ball_size(const YamlMap& map, World& world) {
  const double usual_radius_m = read_ball_radius_m(map);
  if (world.ball_radius_sd_m > kMostTolerance * usual_radius_m)
    map.at("ball_radius_sd_m")
        .refuse(
            fmt::format("expected at most a tenth of ball_radius_m, {:g}", kMostTolerance * usual_radius_m));
  const double off_m = world.balls.empty() ? 0.0 : std::abs(world.balls.front().radius_m - usual_radius_m);
  world.usual_radius_m.reset();
  if (off_m <= kMostRadiusSds * world.ball_radius_sd_m) world.usual_radius_m = usual_radius_m;
}

/// A surface is of a material, or shows a picture.
/// @param texture the key whose picture takes the place of the key `material`
void check_surface(const YamlMap& map, std::string_view texture, std::string_view material) {
  if (const auto value = map.find(texture); value && map.find(material))
    value->refuse(fmt::format("expected no {} beside it", material));
}

YAML::Node written_texture(Material material, const SurfaceTexture& texture) {
  return material == Material::kFile ? surface_texture_keys().write(texture) : YAML::Node();
}

void read_radius(const YamlValue& value, Ball& ball) {
  ball.radius_m = value.number(kRadius_m);
  ball.has_usual_radius = false;
}

YAML::Node written_radius(const Ball& ball) {
  return ball.has_usual_radius ? YAML::Node() : written(Key{}, ball.radius_m);
}

void check_ball(const YamlMap& map, Ball& ball) {
  if (ball.centre_m.z() < ball.radius_m)
    map.at("at_m").fail(fmt::format("expected a height of at least the radius {:g}", ball.radius_m));
}

std::vector<Ball> read_balls(const YamlMap& world) {
  const Ball usual{.radius_m = read_ball_radius_m(world), .has_usual_radius = true};
  std::vector<Ball> balls;
  if (const auto list = world.find("balls"))
    for (const YamlValue& value : list->list(1, kMostBalls))
      ball_keys().read_into(value, balls.emplace_back(usual));
  return balls;
}

void check_wall(const YamlMap& map, WallLine& line) {
  for (std::size_t i = 1; i < line.corners_m.size(); ++i)
    if (line.corners_m[i] == line.corners_m[i - 1])
      map.at("corners_m").list(2, kMostWalls)[i].refuse("expected another corner than the one before");
  check_surface(map, "texture", "material");
}

/// One line of corners is a wall from each corner to the next.
void append_walls(const WallLine& line, std::vector<Wall>& walls) {
  std::vector<Eigen::Vector2d> corners_m = line.corners_m;
  if (line.closed) corners_m.push_back(corners_m.front());
  for (std::size_t i = 0; i + 1 < corners_m.size(); ++i) {
    walls.push_back(line.wall);
    walls.back().from_m = corners_m[i];
    walls.back().to_m = corners_m[i + 1];
  }
}

void check_light(const YamlMap& map, Light& light) {
  if (light.towards_light.norm() < 1e-6)
    map.at("towards_light").refuse("expected a direction (got a vector of length 0)");
}

void read_texture_folders(const YamlValue& list, World& world) {
  for (const YamlValue& value : list.list(1, kMostFolders)) {
    if (!std::filesystem::is_directory(value.path())) value.fail("expected a folder that exists");
    world.texture_search.folders.push_back(value.path().string());
  }
}

/// A floor of some material, or none.
void read_floor(const YamlValue& value, World& world) {
  world.has_floor = value.scalar() != kNoFloor;
  if (world.has_floor) world.floor = static_cast<Material>(value.choice(floor_names()));
}

YAML::Node written_floor(const World& world) {
  if (!world.has_floor) return YAML::Node(std::string(kNoFloor));
  if (world.floor == Material::kFile) return {};
  return YAML::Node(std::string(kMaterialNames[static_cast<std::size_t>(world.floor)]));
}

void check_world(const YamlMap& map, World& world) {
  if (const auto tint = map.find("floor_tint_rgb"); tint && !world.has_floor)
    tint->refuse("expected none where `floor: none` leaves nothing to tint");
  check_surface(map, "floor_texture", "floor");
}

/// Balls, walls and meshes.
std::vector<Field<World>> thing_fields() {
  return {
      group("generator", generator_keys(), "Makes balls and walls in place of lists of them.")
          .otherwise_says("balls"),
      number("ball_radius_m", kRadius_m, "Radius of balls that do not say theirs, in metres.")
          .by<World>(
              [](const YamlValue& value, World& world) { world.usual_radius_m = value.number(kRadius_m); },
              [](const World& world) { return written(Key{}, world.ball_radius_m()); }),
      number("ball_radius_sd_m", kTolerance_m,
             "Tolerance of manufacture: standard deviation of the radii of balls that do not say theirs, "
             "in metres; 0 is exactly known.")
          .fills(&World::ball_radius_sd_m),
      group("balls", ball_keys(), "The landmarks; a ball's place in the list is its identity.")
          .list(1, kMostBalls)
          .needed_unless("generator"),
      group("walls", wall_keys(), "Upright rectangles on the floor, seen from both sides.")
          .list(0, kMostWalls),
      group("meshes", mesh_keys(), "Things from mesh files, boxes and balls that are no landmarks.")
          .list(0, kMostWalls),
      group("mesh_limits", mesh_limit_keys(), "What a mesh file may cost.").fills(&World::mesh_limits),
      text("texture_folders",
           "Folders, relative to the scenario's, in which textures of mesh files may also lie.")
          .list(1, kMostFolders)
          .otherwise_says("beside the mesh file and in its ../materials/textures alone")
          .by<World>(read_texture_folders),
      choice("missing_texture", {"error", "grey"},
             "What becomes of a mesh whose texture is nowhere: an error, or grey in its place.")
          .fills(&World::texture_search, &TextureSearch::missing),
  };
}

/// What is around them.
std::vector<Field<World>> surroundings_fields() {
  return {
      choice("floor", floor_names(), "What the floor is made of; none: nothing is seen in its place.")
          .by<World>(read_floor, written_floor),
      number("floor_tint_rgb", kTint, "Factors on the floor's red, green and blue.")
          .fills(&World::floor_tint_rgb),
      group("floor_texture", surface_texture_keys(), "A picture in place of `floor`.")
          .by<World>(
              [](const YamlValue& value, World& world) {
                world.floor = Material::kFile;
                surface_texture_keys().read_into(value, world.floor_texture);
              },
              [](const World& world) { return written_texture(world.floor, world.floor_texture); }),
      group("light", light_keys(), "Sunlight without shadows.").fills(&World::light),
      number("sky_rgb", kShare, "Colour of what is nothing: red, green, blue.").fills(&World::sky_rgb),
  };
}

}  // namespace

const Fields<Ball>& ball_keys() {
  static const Fields<Ball> keys(
      {
          whole("colour", 0, static_cast<int>(vision::kPalette.size()) - 1, "Index into the palette.")
              .needed()
              .fills(&Ball::colour),
          number("at_m", kPlace_m, "Its centre in the world: x, y, z in metres.")
              .needed()
              .fills(&Ball::centre_m),
          number("radius_m", kRadius_m, "Its radius, in metres.")
              .otherwise_as("world.ball_radius_m")
              .by<Ball>(read_radius, written_radius),
          number("paint_rgb", kShare,
                 "Its red, green and blue under full light, where they are not the palette's.")
              .otherwise_says("the palette's colour")
              .fills(&Ball::paint_rgb),
      },
      check_ball);
  return keys;
}

const Fields<WallLine>& wall_keys() {
  static const Fields<WallLine> keys(
      {
          number("corners_m", kPlace_m, "A wall stands from each corner to the next: x, y in metres.")
              .list(2, kMostWalls, 2)
              .needed()
              .fills(&WallLine::corners_m),
          flag("closed", "Whether a wall leads from the last corner to the first.")
              .written_if_changed()
              .fills(&WallLine::closed),
          number("height_m", kThingSize_m, "Height, in metres.").fills(&WallLine::wall, &Wall::height_m),
          material("material", "What it is made of.").fills(&WallLine::wall, &Wall::material),
          number("tint_rgb", kTint, "Factors on the material's red, green and blue.")
              .written_if_changed()
              .fills(&WallLine::wall, &Wall::tint_rgb),
          group("texture", surface_texture_keys(), "A picture in place of the material.")
              .by<WallLine>(
                  [](const YamlValue& value, WallLine& line) {
                    line.wall.material = Material::kFile;
                    surface_texture_keys().read_into(value, line.wall.texture);
                  },
                  [](const WallLine& line) {
                    return written_texture(line.wall.material, line.wall.texture);
                  }),
      },
      check_wall);
  return keys;
}

const Fields<Light>& light_keys() {
  static const Fields<Light> keys(
      {
          number("towards_light", kPlace_m, "Direction towards the light: x, y, z of any length.")
              .fills(&Light::towards_light),
          number("ambient", kShare, "Light that comes from everywhere.").fills(&Light::ambient),
          number("diffuse", kShare, "Light that falls at a right angle.").fills(&Light::diffuse),
      },
      check_light);
  return keys;
}

const Fields<World>& world_keys() {
  static const Fields<World> keys(joined<World>({thing_fields(), surroundings_fields()}), check_world);
  return keys;
}

double read_ball_radius_m(const YamlMap& world) {
  const auto radius = world.find("ball_radius_m");
  return radius ? radius->number(kRadius_m) : Ball{}.radius_m;
}

World read_world(const YamlValue& value) {
  World world;
  const YamlMap map(value, world_keys());
  if (const auto generator = map.find("generator")) {
    if (map.find("balls") || map.find("walls"))
      generator->refuse("expected no lists of balls and walls beside it: it makes them");
  } else {
    world.balls = read_balls(map);
  }
  world_keys().read_into(value, world);
  check_ball_size(map, world);
  if (const auto walls = map.find("walls"))
    for (const YamlValue& line : walls->list(0, kMostWalls))
      append_walls(wall_keys().read(line), world.walls);
  if (const auto meshes = map.find("meshes"))
    for (const YamlValue& mesh : meshes->list(0, kMostWalls))
      world.meshes.push_back(read_mesh(mesh, world.balls));
  return world;
}

}  // namespace stereobench::worlds
