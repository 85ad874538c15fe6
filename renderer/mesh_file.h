/// Triangles read from files of common mesh formats.
#pragma once

#include <filesystem>
#include <vector>

#include <Eigen/Core>

#include "worlds/types.h"

namespace stereobench::renderer {

/// A triangle in the mesh's own axes and units.
struct Triangle {
  Eigen::Vector3d corners[3];
  Eigen::Vector3d normals[3];  ///< unit length, outward; the face's own where the file has none
  Eigen::Vector3d colour_rgb;  ///< the diffuse colour of its material, taken as linear light, in [0, 1]
};

/// Reads all triangles of a mesh file; larger faces are cut into triangles, points and lines have no area and
/// are passed over. A child process does it, as files can crash, hang or bloat the library that reads them.
/// @param file its ending says the format: obj, dae, gltf, glb, stl or fbx
/// @return at least one triangle, coordinates of at most a million units
/// @throws std::runtime_error of one line, "file: why": another ending, unreadable, incomplete, without
///   faces, coordinates that are not finite or absurd, indices out of range, beyond a limit, or a crash
std::vector<Triangle> read_mesh(const std::filesystem::path& file, const worlds::MeshLimits& limits = {});

}  // namespace stereobench::renderer
