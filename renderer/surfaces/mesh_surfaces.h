/// The meshes of a world, put in place and lit once: nothing of them changes while the robot drives.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "renderer/meshes/mesh_file.h"
#include "renderer/surfaces/surface_polygons.h"

namespace stereobench::renderer {

/// A mesh instance, or its part of one colour, as a run of triangles in one list of vertices.
struct MeshRun {
  int mesh = 0;  ///< index into World::meshes
  worlds::Material material = worlds::Material::kPlain;
  Eigen::Vector3f tint_rgb = Eigen::Vector3f::Ones();  ///< factors on its colours; of kFile, the colour
  int texture = -1;                                    ///< index into MeshSurfaces::textures
  bool has_corner_colours = false;
  bool one_sided = false;                              ///< seen from the side that it faces alone
  int first = 0;                                       ///< vertex
  int count = 0;                                       ///< vertices, three for each triangle
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();  ///< of a sphere around it, world frame
  double radius_m = 0.0;
};

struct MeshSurfaces {
  std::vector<SurfaceVertex> vertices;  ///< positions in the world frame
  std::vector<MeshRun> runs;            ///< in the order of World::meshes, at least one for each
  std::vector<Texture> textures;        ///< of material kFile
  std::vector<std::string> missing;     ///< a line for each file whose textures are grey, as they are nowhere
};

/// Whether an instance of the same file shows the file's colours.
bool shows_file(const worlds::World& world, const worlds::MeshInstance& mesh);

/// What a mesh of a world is made of, with textures where they are shown.
/// @throws std::runtime_error as read_textured_mesh
Mesh read_form(const worlds::World& world, const worlds::MeshInstance& mesh);
using FormReader = std::function<Mesh(const worlds::World& world, const worlds::MeshInstance& mesh)>;

/// Reads each mesh file once and puts its instances in their places.
/// @throws std::runtime_error as read_form, naming the file with which there are too many triangles or
/// texels, or, a line for each file, all textures that are missing, unless the world takes grey for them
MeshSurfaces place_meshes(const worlds::World& world, const FormReader& read = read_form);

/// Whether any of a run can be in the camera's picture.
bool can_see(const CameraView& view, const MeshRun& run);

}  // namespace stereobench::renderer
