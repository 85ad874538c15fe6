#include <array>
#include <numbers>
#include <span>

#include "worlds/scenario_parts.h"

namespace stereobench::worlds {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr Interval kPlace_m = {-1e4, 1e4};
constexpr Interval kFactor = {1e-3, 1e3};
constexpr Interval kTurn_deg = {-360.0, 360.0};
constexpr std::array<std::string_view, 2> kUps = {"z", "y"};

/// Puts a mesh of unit height between the floor and the ball that `ball` names.
void stand_under(const YamlValue& ball, const std::vector<Ball>& balls, MeshInstance& mesh) {
  mesh.carried_ball = ball.integer(0, static_cast<int>(balls.size()) - 1);
  const Ball& carried = balls[static_cast<std::size_t>(mesh.carried_ball)];
  const double height_m = carried.centre_m.z() - carried.radius_m;
  if (height_m < 1e-3) ball.fail("expected a ball above the floor");
  mesh.position_m = {carried.centre_m.x(), carried.centre_m.y(), 0.0};
  mesh.scale.z() = height_m / mesh.unit_m;
}

/// One factor, or one for each axis.
Eigen::Vector3d read_scale(const YamlValue& value) {
  return value.is_list() ? read_vector<3>(value, kFactor) : Eigen::Vector3d::Constant(value.number(kFactor));
}

/// A file that exists, or a shape of our own.
void read_form(const YamlValue& value, const YamlMap& map, const std::filesystem::path& folder,
               MeshInstance& mesh) {
  const auto shape = map.find("shape");
  const auto file = map.find("file");
  if (shape && file) value.refuse("expected either file or shape");
  if (shape) {
    mesh.shape = static_cast<MeshShape>(1 + shape->choice(kShapeNames));
    mesh.material = Material::kPaint;
    return;
  }
  const std::filesystem::path path =
      std::filesystem::absolute(folder / map.at("file").text()).lexically_normal();
  if (!std::filesystem::is_regular_file(path)) file->fail("expected a mesh file that exists");
  mesh.file = path.string();
}

/// Shapes have no file whose colours could be taken.
Material read_material(const YamlValue& value, MeshShape shape) {
  const std::size_t known = kMaterialNames.size() - (shape == MeshShape::kFile ? 0 : 1);
  return static_cast<Material>(value.choice(std::span(kMaterialNames).first(known)));
}

}  // namespace

MeshInstance read_mesh(const YamlValue& value, const std::filesystem::path& folder,
                       const std::vector<Ball>& balls) {
  const YamlMap map(value, {"file", "shape", "unit_m", "up", "at_m", "under_ball", "heading_deg", "pitch_deg",
                            "roll_deg", "scale", "material", "tint_rgb"});
  MeshInstance mesh;
  read_form(value, map, folder, mesh);
  mesh.unit_m = map.number("unit_m", {1e-6, 1e3}, 1.0);
  if (const auto up = map.find("up")) mesh.up = static_cast<MeshUp>(up->choice(kUps));
  mesh.heading_rad = map.number("heading_deg", kTurn_deg, 0.0) * kDegree;
  mesh.pitch_rad = map.number("pitch_deg", kTurn_deg, 0.0) * kDegree;
  mesh.roll_rad = map.number("roll_deg", kTurn_deg, 0.0) * kDegree;
  if (const auto scale = map.find("scale")) mesh.scale = read_scale(*scale);
  const auto at = map.find("at_m");
  const auto ball = map.find("under_ball");
  if (at.has_value() == ball.has_value()) value.refuse("expected either at_m or under_ball");
  if (at) mesh.position_m = read_vector<3>(*at, kPlace_m);
  if (ball) stand_under(*ball, balls, mesh);
  if (const auto material = map.find("material")) mesh.material = read_material(*material, mesh.shape);
  if (const auto tint = map.find("tint_rgb")) mesh.tint_rgb = read_vector<3>(*tint, kTint);
  return mesh;
}

MeshLimits read_mesh_limits(const YamlValue& value) {
  const YamlMap map(value, {"triangles", "file_mib", "seconds", "memory_mib", "texture_px", "texture_mib"});
  MeshLimits limits;
  if (const auto most = map.find("triangles")) limits.triangles = most->integer(1, 100000000);
  if (const auto most = map.find("file_mib")) limits.file_mib = most->integer(1, 65536);
  if (const auto most = map.find("memory_mib")) limits.memory_mib = most->integer(1, 1048576);
  if (const auto most = map.find("texture_px")) limits.texture_px = most->integer(1, 32768);
  if (const auto most = map.find("texture_mib")) limits.texture_mib = most->integer(1, 512);
  limits.seconds = map.number("seconds", {1e-3, 3600.0}, limits.seconds);
  return limits;
}

}  // namespace stereobench::worlds
