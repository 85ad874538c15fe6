#include "renderer/mesh_surfaces.h"

#include <algorithm>
#include <array>
#include <map>

namespace stereobench::renderer {
namespace {

/// Where points and normals of an instance go: world = position + turn * (scale * mesh).
struct Placement {
  Eigen::Matrix3d turn;
  Eigen::Vector3d scale;
  Eigen::Vector3d position_m;

  Eigen::Vector3d upright(const Eigen::Vector3d& point) const { return scale.cwiseProduct(point); }
  Eigen::Vector3d normal(const Eigen::Vector3d& mesh_normal) const {
    return (turn * mesh_normal.cwiseQuotient(scale)).stableNormalized();
  }
};

/// The axes of the mesh that run along and up a face: across its most upright way for walls, x and y for
/// floors.
std::array<int, 2> axes_on(const Triangle& triangle) {
  const Eigen::Vector3d flat =
      (triangle.corners[1] - triangle.corners[0]).cross(triangle.corners[2] - triangle.corners[0]).cwiseAbs();
  if (flat.z() >= flat.x() && flat.z() >= flat.y()) return {0, 1};
  return flat.x() >= flat.y() ? std::array<int, 2>{1, 2} : std::array<int, 2>{0, 2};
}

void append(const Triangle& triangle, const Placement& placement, const worlds::Light& light,
            std::vector<SurfaceVertex>& vertices) {
  const std::array<int, 2> axes = axes_on(triangle);
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d upright = placement.upright(triangle.corners[i]);
    const Eigen::Vector3f place = (placement.position_m + placement.turn * upright).cast<float>();
    vertices.push_back({{place.x(), place.y(), place.z(), 1.0F},
                        {static_cast<float>(upright[axes[0]]), static_cast<float>(upright[axes[1]])},
                        static_cast<float>(lit(light, placement.normal(triangle.normals[i])))});
  }
}

Eigen::Vector3d position(const SurfaceVertex& vertex) {
  return Eigen::Vector3f(vertex.position).cast<double>();
}

void enclose(const std::vector<SurfaceVertex>& vertices, MeshRun& run) {
  const auto first = vertices.begin() + run.first;
  Eigen::AlignedBox3d box;
  std::for_each(first, first + run.count, [&](const SurfaceVertex& vertex) { box.extend(position(vertex)); });
  run.centre_m = box.center();
  run.radius_m = 0.5 * box.diagonal().norm();
}

}  // namespace

MeshSurfaces place_meshes(const worlds::World& world) {
  std::map<std::string, std::vector<Triangle>> files;
  MeshSurfaces surfaces;
  for (const worlds::MeshInstance& mesh : world.meshes) {
    const auto [file, is_new] = files.try_emplace(mesh.file);
    if (is_new) file->second = read_mesh(mesh.file);
    const Placement placement{
        Eigen::AngleAxisd(mesh.heading_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix(), mesh.scale,
        mesh.position_m};
    MeshRun run{mesh.material, static_cast<int>(surfaces.vertices.size()), 0, {}, 0.0};
    for (const Triangle& triangle : file->second) append(triangle, placement, world.light, surfaces.vertices);
    run.count = static_cast<int>(surfaces.vertices.size()) - run.first;
    enclose(surfaces.vertices, run);
    surfaces.runs.push_back(run);
  }
  return surfaces;
}

bool can_see(const EyeView& view, const MeshRun& run) {
  const Eigen::Vector4d centre = (view.camera_from_world * run.centre_m).homogeneous();
  const auto planes = frustum_in_camera(view.camera);
  return std::all_of(planes.begin(), planes.end(), [&](const Eigen::Vector4d& plane) {
    return plane.dot(centre) >= -run.radius_m * plane.head<3>().norm();
  });
}

}  // namespace stereobench::renderer
