#include <span>

#include "slam/math/angles.h"
#include "worlds/scenario/scenario_parts.h"

namespace stereobench::worlds {
namespace {

constexpr Interval kPlace_m = {-1e4, 1e4};
constexpr Interval kTurn_deg = {-360.0, 360.0};

/// Puts a mesh of unit height between the floor and the ball that `ball` names.
void stand_under(const YamlValue& ball, const std::vector<Ball>& balls, MeshInstance& mesh) {
  mesh.carried_ball = ball.integer(0, static_cast<int>(balls.size()) - 1);
  const Ball& carried = balls[static_cast<std::size_t>(mesh.carried_ball)];
  const double height_m = carried.centre_m.z() - carried.radius_m;
  if (height_m < 1e-3) ball.fail("expected a ball above the floor");
  mesh.position_m = {carried.centre_m.x(), carried.centre_m.y(), 0.0};
  mesh.scale.z() = height_m / mesh.unit_m;
}

/// A file that exists, or a shape of our own.
void read_form(const YamlValue& value, const YamlMap& map, const std::filesystem::path& folder,
               MeshInstance& mesh) {
  const auto shape = map.find("shape");
  if (shape && map.find("file")) value.refuse("expected either file or shape");
  if (shape) {
    mesh.shape = static_cast<MeshShape>(1 + map.choice("shape"));
    mesh.material = Material::kPaint;
    return;
  }
  const YamlValue file = map.at("file");
  const std::filesystem::path path = std::filesystem::absolute(folder / file.text()).lexically_normal();
  if (!std::filesystem::is_regular_file(path)) file.fail("expected a mesh file that exists");
  mesh.file = path.string();
}

/// Shapes have no file whose colours could be taken.
Material read_material(const YamlValue& value, MeshShape shape) {
  const std::size_t known = kMaterialNames.size() - (shape == MeshShape::kFile ? 0 : 1);
  return static_cast<Material>(value.choice(std::span(kMaterialNames).first(known)));
}

}  // namespace

const KeyGroup& mesh_keys() {
  static const KeyGroup keys = {
      .keys = {
          text("file", "Mesh file (obj, dae, gltf, glb, stl, fbx), relative to the scenario's folder.")
              .needed_unless("shape"),
          choice("shape", {kShapeNames.begin(), kShapeNames.end()},
                 "A shape of unit size in place of a file.")
              .otherwise_says("file"),
          number("unit_m", {1e-6, 1e3}, "Length of the file's unit, in metres.").otherwise("1"),
          choice("up", {"z", "y"}, "Which of the file's axes points up.").otherwise("z"),
          number("at_m", kPlace_m, "Where its origin stands in the world: x, y, z in metres.")
              .vector(3)
              .needed_unless("under_ball"),
          whole("under_ball", 0, 253,
                "Index of the ball that it carries: it reaches from the floor up to it.")
              .otherwise_says("at_m"),
          number("heading_deg", kTurn_deg, "Turn about the vertical axis, in degrees, after pitch and roll.")
              .otherwise("0"),
          number("pitch_deg", kTurn_deg, "Turn about the y axis, in degrees, after roll.").otherwise("0"),
          number("roll_deg", kTurn_deg, "Turn about the x axis, in degrees.").otherwise("0"),
          number("scale", {1e-3, 1e3}, "Factor on its size, or one for each axis.")
              .or_vector(3)
              .otherwise("[1, 1, 1]"),
          choice("material", {kMaterialNames.begin(), kMaterialNames.end()},
                 "What it is made of; `file` takes the file's own colours and textures.")
              .otherwise_says("wood; paint for a shape"),
          number("tint_rgb", kTint, "Factors on the material's red, green and blue.")
              .vector(3)
              .otherwise("[1, 1, 1]"),
      }};
  return keys;
}

MeshInstance read_mesh(const YamlValue& value, const std::filesystem::path& folder,
                       const std::vector<Ball>& balls) {
  const YamlMap map(value, mesh_keys());
  MeshInstance mesh;
  read_form(value, map, folder, mesh);
  mesh.unit_m = map.number("unit_m", mesh.unit_m);
  mesh.up = read_choice(map, "up", mesh.up);
  mesh.heading_rad = map.number("heading_deg", 0.0) * slam::kRadPerDegree;
  mesh.pitch_rad = map.number("pitch_deg", 0.0) * slam::kRadPerDegree;
  mesh.roll_rad = map.number("roll_deg", 0.0) * slam::kRadPerDegree;
  mesh.scale = read_vector<3>(map, "scale", mesh.scale);
  const auto ball = map.find("under_ball");
  if (ball && map.find("at_m")) value.refuse("expected either at_m or under_ball");
  if (ball)
    stand_under(*ball, balls, mesh);
  else
    mesh.position_m = read_vector<3>(map, "at_m");
  if (const auto material = map.find("material")) mesh.material = read_material(*material, mesh.shape);
  mesh.tint_rgb = read_vector<3>(map, "tint_rgb", mesh.tint_rgb);
  return mesh;
}

const KeyGroup& mesh_limit_keys() {
  static const KeyGroup keys = {
      .keys = {
          whole("triangles", 1, 100000000, "Triangles of a file, and of all instances in the world together.")
              .otherwise("2000000"),
          whole("file_mib", 1, 65536, "Size of a mesh file, in MiB.").otherwise("64"),
          number("seconds", {1e-3, 3600.0}, "Time to read a file, in seconds.").otherwise("4"),
          whole("memory_mib", 1, 1048576, "Memory to read a file, in MiB.").otherwise("1024"),
          whole("texture_px", 1, 32768, "Longer side of a texture, in pixels.").otherwise("4096"),
          whole("texture_mib", 1, 512, "All textures of the world together, as they are drawn, in MiB.")
              .otherwise("256"),
      }};
  return keys;
}

MeshLimits read_mesh_limits(const YamlValue& value) {
  const YamlMap map(value, mesh_limit_keys());
  MeshLimits limits;
  limits.triangles = map.whole("triangles", limits.triangles);
  limits.file_mib = map.whole("file_mib", limits.file_mib);
  limits.seconds = map.number("seconds", limits.seconds);
  limits.memory_mib = map.whole("memory_mib", limits.memory_mib);
  limits.texture_px = map.whole("texture_px", limits.texture_px);
  limits.texture_mib = map.whole("texture_mib", limits.texture_mib);
  return limits;
}

}  // namespace stereobench::worlds
