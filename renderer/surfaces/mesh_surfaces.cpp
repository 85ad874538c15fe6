#include "renderer/surfaces/mesh_surfaces.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <stdexcept>

#include <fmt/format.h>

#include "renderer/meshes/duplicate_back_faces.h"
#include "renderer/surfaces/unit_shapes.h"
#include "renderer/textures/mip_chain.h"
#include "renderer/textures/texture_file.h"
#include "worlds/visibility/mesh_placement.h"

namespace stereobench::renderer {
namespace {

using worlds::MeshPlacement;

Eigen::Vector3d turned_normal(const MeshPlacement& placement, const Eigen::Vector3d& mesh_normal) {
  return (placement.turn * mesh_normal.cwiseQuotient(placement.scale)).stableNormalized();
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

void append(const Triangle& triangle, const MeshPlacement& placement, const MeshRun& run,
            const worlds::Light& light, std::vector<SurfaceVertex>& vertices) {
  const std::array<int, 2> axes = axes_on(triangle);
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d upright = placement.scale.cwiseProduct(triangle.corners[i]);
    const Eigen::Vector3f place = (placement.position_m + placement.turn * upright).cast<float>();
    const Eigen::Vector2f along = run.texture >= 0
                                      ? triangle.place_px[i]
                                      : Eigen::Vector2d(upright[axes[0]], upright[axes[1]]).cast<float>();
    const Eigen::Vector3f& rgb = triangle.corner_rgb[i];
    vertices.push_back({{place.x(), place.y(), place.z(), 1.0F},
                        {along.x(), along.y()},
                        static_cast<float>(lit(light, turned_normal(placement, triangle.normals[i]))),
                        {rgb.x(), rgb.y(), rgb.z()}});
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
  int first_texture = 0;  ///< of the world's
};

/// Puts a shape's textures beside the others, and notes which are missing.
Shape add_shape(Mesh form, const worlds::World& world, const worlds::MeshInstance& mesh,
                MeshSurfaces& surfaces) {
  std::vector<Texture>& textures = surfaces.textures;
  if (!form.missing_textures.empty())
    surfaces.missing.push_back(fmt::format("{}: {}", mesh.file, complaint(form.missing_textures)));
  Shape shape{std::move(form.triangles), {}, static_cast<int>(textures.size())};
  shape.one_sided = have_opposites(shape.triangles);
  std::move(form.textures.begin(), form.textures.end(), std::back_inserter(textures));
  if (exceed(textures, world.mesh_limits))
    throw std::runtime_error(fmt::format("{}: with it the world's textures are more than {} MiB", mesh.file,
                                         world.mesh_limits.texture_mib));
  return shape;
}

/// The factors on a triangle's colours: its instance's and, where the file's colours are shown, its own.
Eigen::Vector3f tint_of(const worlds::MeshInstance& mesh, const Triangle& triangle) {
  if (mesh.material != worlds::Material::kFile) return mesh.tint_rgb.cast<float>();
  return mesh.tint_rgb.cwiseProduct(triangle.colour_rgb).cast<float>();
}

/// The run that a triangle is of, without its vertices.
MeshRun run_of(int index, const worlds::MeshInstance& mesh, const Shape& shape, std::size_t triangle) {
  const Triangle& t = shape.triangles[triangle];
  MeshRun run{.mesh = index,
              .material = mesh.material,
              .tint_rgb = tint_of(mesh, t),
              .one_sided = shape.one_sided[triangle]};
  if (mesh.material != worlds::Material::kFile) return run;
  run.texture = t.texture < 0 ? -1 : shape.first_texture + t.texture;
  run.has_corner_colours = std::any_of(t.corner_rgb, t.corner_rgb + 3, [](const Eigen::Vector3f& rgb) {
    return rgb != Eigen::Vector3f::Ones();
  });
  return run;
}

bool goes_on(const MeshRun& a, const MeshRun& b) {
  return a.one_sided == b.one_sided && a.tint_rgb == b.tint_rgb && a.texture == b.texture &&
         a.has_corner_colours == b.has_corner_colours;
}

void place(const worlds::World& world, int index, const Shape& shape, MeshSurfaces& surfaces) {
  const worlds::MeshInstance& mesh = world.meshes[static_cast<std::size_t>(index)];
  const MeshPlacement placement = placement_of(mesh);
  const std::size_t first_run = surfaces.runs.size();
  for (std::size_t i = 0; i < shape.triangles.size(); ++i) {
    const MeshRun run = run_of(index, mesh, shape, i);
    if (surfaces.runs.size() == first_run || !goes_on(surfaces.runs.back(), run)) {
      surfaces.runs.push_back(run);
      surfaces.runs.back().first = static_cast<int>(surfaces.vertices.size());
    }
    append(stood_up(shape.triangles[i], mesh.up), placement, run, world.light, surfaces.vertices);
    surfaces.runs.back().count += 3;
  }
  for (std::size_t i = first_run; i < surfaces.runs.size(); ++i) enclose(surfaces.vertices, surfaces.runs[i]);
}

}  // namespace

bool shows_file(const worlds::World& world, const worlds::MeshInstance& mesh) {
  return std::any_of(world.meshes.begin(), world.meshes.end(), [&](const worlds::MeshInstance& other) {
    return other.shape == mesh.shape && other.file == mesh.file && other.material == worlds::Material::kFile;
  });
}

Mesh read_form(const worlds::World& world, const worlds::MeshInstance& mesh) {
  if (mesh.shape != worlds::MeshShape::kFile) return {unit_shape(mesh.shape), {}};
  if (shows_file(world, mesh))
    return read_textured_mesh(mesh.file, world.mesh_limits, world.texture_search.folders);
  return {read_mesh(mesh.file, world.mesh_limits), {}};
}

MeshSurfaces place_meshes(const worlds::World& world, const FormReader& read) {
  std::map<std::pair<worlds::MeshShape, std::string>, Shape> shapes;
  MeshSurfaces surfaces;
  const auto most_vertices = 3 * static_cast<std::size_t>(world.mesh_limits.triangles);
  for (std::size_t i = 0; i < world.meshes.size(); ++i) {
    const worlds::MeshInstance& mesh = world.meshes[i];
    const auto [shape, is_new] = shapes.try_emplace({mesh.shape, mesh.file});
    if (is_new) shape->second = add_shape(read(world, mesh), world, mesh, surfaces);
    if (surfaces.vertices.size() + 3 * shape->second.triangles.size() > most_vertices)
      throw std::runtime_error(fmt::format("{}: with it the world has more than {} triangles", mesh.file,
                                           world.mesh_limits.triangles));
    place(world, static_cast<int>(i), shape->second, surfaces);
  }
  if (!surfaces.missing.empty() && world.texture_search.missing == worlds::MissingTexturePolicy::kError)
    throw std::runtime_error(fmt::format("{}; or draw grey in their place with world.missing_texture: grey",
                                         fmt::join(surfaces.missing, "\n")));
  return surfaces;
}

bool can_see(const CameraView& view, const MeshRun& run) {
  const Eigen::Vector4d centre = (view.camera_from_world * run.centre_m).homogeneous();
  const auto planes = frustum_in_camera(view.intrinsics);
  return std::all_of(planes.begin(), planes.end(), [&](const Eigen::Vector4d& plane) {
    return plane.dot(centre) >= -run.radius_m * plane.head<3>().norm();
  });
}

}  // namespace stereobench::renderer
