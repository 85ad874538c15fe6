#include "renderer/mesh_surfaces.h"

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>

#include <fmt/core.h>

#include "renderer/opposite_faces.h"

namespace stereobench::renderer {
namespace {

/// Where points and normals of an instance go: world = position + turn * (scale * mesh), z of the mesh up.
struct Placement {
  Eigen::Matrix3d turn;
  Eigen::Vector3d scale;
  Eigen::Vector3d position_m;

  Eigen::Vector3d upright(const Eigen::Vector3d& point) const { return scale.cwiseProduct(point); }
  Eigen::Vector3d normal(const Eigen::Vector3d& mesh_normal) const {
    return (turn * mesh_normal.cwiseQuotient(scale)).stableNormalized();
  }
};

Placement placement_of(const worlds::MeshInstance& mesh) {
  const auto about = [](double angle_rad, const Eigen::Vector3d& axis) {
    return Eigen::AngleAxisd(angle_rad, axis).toRotationMatrix();
  };
  return {about(mesh.heading_rad, Eigen::Vector3d::UnitZ()) *
              about(mesh.pitch_rad, Eigen::Vector3d::UnitY()) *
              about(mesh.roll_rad, Eigen::Vector3d::UnitX()),
          mesh.unit_m * mesh.scale, mesh.position_m};
}

/// The triangle with its file's up axis as z; exact, nothing is computed.
Triangle stood_up(Triangle triangle, worlds::MeshUp up) {
  if (up == worlds::MeshUp::kZ) return triangle;
  for (Eigen::Vector3d* vectors : {triangle.corners, triangle.normals})
    for (int i = 0; i < 3; ++i) vectors[i] = Eigen::Vector3d(vectors[i].x(), -vectors[i].z(), vectors[i].y());
  return triangle;
}

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

/// A mesh file's triangles, and which of them have another on their back.
struct Shape {
  std::vector<Triangle> triangles;
  std::vector<bool> one_sided;
};

Shape read_shape(const std::string& file, const worlds::MeshLimits& limits) {
  Shape shape{read_mesh(file, limits), {}};
  shape.one_sided = have_opposites(shape.triangles);
  return shape;
}

/// Whether a triangle of an instance goes on with the run: its sides do, and where the file's colours are
/// shown, its colour.
bool goes_on(const MeshRun& run, const Triangle& triangle, bool one_sided) {
  return run.one_sided == one_sided &&
         (run.material != worlds::Material::kFile || run.colour_rgb == triangle.colour_rgb.cast<float>());
}

void place(const worlds::World& world, int index, const Shape& shape, MeshSurfaces& surfaces) {
  const worlds::MeshInstance& mesh = world.meshes[static_cast<std::size_t>(index)];
  const Placement placement = placement_of(mesh);
  const std::size_t first_run = surfaces.runs.size();
  for (std::size_t i = 0; i < shape.triangles.size(); ++i) {
    const Triangle& triangle = shape.triangles[i];
    if (surfaces.runs.size() == first_run || !goes_on(surfaces.runs.back(), triangle, shape.one_sided[i])) {
      surfaces.runs.push_back({.mesh = index,
                               .material = mesh.material,
                               .colour_rgb = triangle.colour_rgb.cast<float>(),
                               .one_sided = shape.one_sided[i],
                               .first = static_cast<int>(surfaces.vertices.size())});
    }
    append(stood_up(triangle, mesh.up), placement, world.light, surfaces.vertices);
    surfaces.runs.back().count += 3;
  }
  for (std::size_t i = first_run; i < surfaces.runs.size(); ++i) enclose(surfaces.vertices, surfaces.runs[i]);
}

}  // namespace

MeshSurfaces place_meshes(const worlds::World& world) {
  std::map<std::string, Shape> files;
  MeshSurfaces surfaces;
  const auto most_vertices = 3 * static_cast<std::size_t>(world.mesh_limits.triangles);
  for (std::size_t i = 0; i < world.meshes.size(); ++i) {
    const worlds::MeshInstance& mesh = world.meshes[i];
    const auto [file, is_new] = files.try_emplace(mesh.file);
    if (is_new) file->second = read_shape(mesh.file, world.mesh_limits);
    if (surfaces.vertices.size() + 3 * file->second.triangles.size() > most_vertices)
      throw std::runtime_error(fmt::format("{}: with it the world has more than {} triangles", mesh.file,
                                           world.mesh_limits.triangles));
    place(world, static_cast<int>(i), file->second, surfaces);
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
