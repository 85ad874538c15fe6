#include <span>

#include "slam/math/angles.h"
#include "worlds/scenario/scenario_parts.h"

namespace stereobench::worlds {
namespace {

/// Puts a mesh of unit height between the floor and the ball that `ball` names.
void stand_under(const YamlValue& ball, const std::vector<Ball>& balls, MeshInstance& mesh) {
  mesh.carried_ball = ball.integer(0, static_cast<int>(balls.size()) - 1);
  const Ball& carried = balls[static_cast<std::size_t>(mesh.carried_ball)];
  const double height_m = carried.centre_m.z() - carried.radius_m;
  if (height_m < 1e-3) ball.fail("expected a ball above the floor");
  mesh.position_m = {carried.centre_m.x(), carried.centre_m.y(), 0.0};
  mesh.scale.z() = height_m / mesh.unit_m;
}

void read_mesh_file(const YamlValue& file, MeshInstance& mesh) {
  if (!std::filesystem::is_regular_file(file.path())) file.fail("expected a mesh file that exists");
  mesh.file = file.path().string();
}

void read_shape(const YamlValue& value, MeshInstance& mesh) {
  mesh.shape = static_cast<MeshShape>(1 + value.choice(kShapeNames));
  mesh.material = Material::kPaint;
}

YAML::Node written_shape(const MeshInstance& mesh) {
  if (mesh.shape == MeshShape::kFile) return {};
  return YAML::Node(std::string(kShapeNames[static_cast<std::size_t>(mesh.shape) - 1]));
}

/// Shapes have no file whose colours could be taken.
void read_material(const YamlValue& value, MeshInstance& mesh) {
  const std::size_t known = kMaterialNames.size() - (mesh.shape == MeshShape::kFile ? 0 : 1);
  mesh.material = static_cast<Material>(value.choice(std::span(kMaterialNames).first(known)));
}

void check_mesh(const YamlMap& map, MeshInstance&) {
  if (map.find("shape") && map.find("file")) map.value().refuse("expected either file or shape");
  if (map.find("under_ball") && map.find("at_m")) map.value().refuse("expected either at_m or under_ball");
}

/// Of the file or shape.
std::vector<Field<MeshInstance>> form_fields() {
  return {
      text("file", "Mesh file (obj, dae, gltf, glb, stl, fbx), relative to the scenario's folder.")
          .needed_unless("shape")
          .by<MeshInstance>(read_mesh_file),
      choice("shape", {kShapeNames.begin(), kShapeNames.end()}, "A shape of unit size in place of a file.")
          .otherwise_says("file")
          .by<MeshInstance>(read_shape, written_shape),
      number("unit_m", {1e-6, 1e3}, "Length of the file's unit, in metres.")
          .written_if_changed()
          .fills(&MeshInstance::unit_m),
      choice("up", {"z", "y"}, "Which of the file's axes points up.")
          .written_if_changed()
          .fills(&MeshInstance::up),
  };
}

std::vector<Field<MeshInstance>> placement_fields() {
  return {
      number("at_m", kPlace_m, "Where its origin stands in the world: x, y, z in metres.")
          .needed_unless("under_ball")
          .fills(&MeshInstance::position_m),
      whole("under_ball", 0, 253, "Index of the ball that it carries: it reaches from the floor up to it.")
          .otherwise_says("at_m"),
      number("heading_deg", kTurn_deg, "Turn about the vertical axis, in degrees, after pitch and roll.")
          .times(slam::kRadPerDegree)
          .fills(&MeshInstance::heading_rad),
      number("pitch_deg", kTurn_deg, "Turn about the y axis, in degrees, after roll.")
          .times(slam::kRadPerDegree)
          .written_if_changed()
          .fills(&MeshInstance::pitch_rad),
      number("roll_deg", kTurn_deg, "Turn about the x axis, in degrees.")
          .times(slam::kRadPerDegree)
          .written_if_changed()
          .fills(&MeshInstance::roll_rad),
      number("scale", {1e-3, 1e3}, "Factor on its size, or one for each axis.")
          .or_vector(3)
          .fills(&MeshInstance::scale),
  };
}

std::vector<Field<MeshInstance>> material_fields() {
  return {
      choice("material", {kMaterialNames.begin(), kMaterialNames.end()},
             "What it is made of; `file` takes the file's own colours and textures.")
          .otherwise_says("wood; paint for a shape")
          .fills(&MeshInstance::material)
          .reading(read_material),
      number("tint_rgb", kTint, "Factors on the material's red, green and blue.")
          .fills(&MeshInstance::tint_rgb),
  };
}

}  // namespace

const Fields<MeshInstance>& mesh_keys() {
  static const Fields<MeshInstance> keys(
      joined<MeshInstance>({form_fields(), placement_fields(), material_fields()}), check_mesh);
  return keys;
}

MeshInstance read_mesh(const YamlValue& value, const std::vector<Ball>& balls) {
  MeshInstance mesh = mesh_keys().read(value);
  if (const auto ball = YamlMap(value, mesh_keys()).find("under_ball")) stand_under(*ball, balls, mesh);
  return mesh;
}

const Fields<MeshLimits>& mesh_limit_keys() {
  static const Fields<MeshLimits> keys({
      whole("triangles", 1, 100000000, "Triangles of a file, and of all instances in the world together.")
          .fills(&MeshLimits::triangles),
      whole("file_mib", 1, 65536, "Size of a mesh file, in MiB.").fills(&MeshLimits::file_mib),
      number("seconds", {1e-3, 3600.0}, "Processor time to read a file, in seconds.")
          .fills(&MeshLimits::seconds),
      whole("memory_mib", 1, 1048576, "Memory to read a file, in MiB.").fills(&MeshLimits::memory_mib),
      whole("texture_px", 1, 32768, "Longer side of a texture, in pixels.").fills(&MeshLimits::texture_px),
      whole("texture_mib", 1, 512, "All textures of the world together, as they are drawn, in MiB.")
          .fills(&MeshLimits::texture_mib),
  });
  return keys;
}

}  // namespace stereobench::worlds
