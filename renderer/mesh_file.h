/// Triangles read from files of common mesh formats.
#pragma once

#include <filesystem>
#include <vector>

#include <Eigen/Core>

namespace stereobench::renderer {

/// A triangle in the mesh's own axes and units.
struct Triangle {
  Eigen::Vector3d corners[3];
  Eigen::Vector3d normals[3];  ///< unit length, outward; the face's own where the file has none
};

/// Reads all triangles of a mesh file; larger faces are cut into triangles, points and lines have no area and
/// are passed over.
/// @param file its ending says the format: obj, dae, gltf, glb, stl or fbx
/// @return at least one triangle, coordinates of at most a million units
/// @throws std::runtime_error naming the file: another ending, unreadable, incomplete, without
///   faces, coordinates that are not finite or absurd, indices out of range
std::vector<Triangle> read_mesh(const std::filesystem::path& file);

}  // namespace stereobench::renderer
