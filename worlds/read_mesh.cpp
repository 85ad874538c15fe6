#include <array>
#include <numbers>

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

}  // namespace

MeshInstance read_mesh(const YamlValue& value, const std::filesystem::path& folder,
                       const std::vector<Ball>& balls) {
  const YamlMap map(value, {"file", "unit_m", "up", "at_m", "under_ball", "heading_deg", "pitch_deg",
                            "roll_deg", "scale", "material"});
  MeshInstance mesh;
  const std::filesystem::path file =
      std::filesystem::absolute(folder / map.at("file").text()).lexically_normal();
  if (!std::filesystem::is_regular_file(file)) map.at("file").fail("expected a mesh file that exists");
  mesh.file = file.string();
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
  if (const auto material = map.find("material"))
    mesh.material = static_cast<Material>(material->choice(kMaterialNames));
  return mesh;
}

MeshLimits read_mesh_limits(const YamlValue& value) {
  const YamlMap map(value, {"triangles", "file_mib", "seconds", "memory_mib"});
  MeshLimits limits;
  if (const auto most = map.find("triangles")) limits.triangles = most->integer(1, 100000000);
  if (const auto most = map.find("file_mib")) limits.file_mib = most->integer(1, 65536);
  if (const auto most = map.find("memory_mib")) limits.memory_mib = most->integer(1, 1048576);
  limits.seconds = map.number("seconds", {1e-3, 3600.0}, limits.seconds);
  return limits;
}

}  // namespace stereobench::worlds
