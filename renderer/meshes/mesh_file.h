/// Triangles read from files of common mesh formats.
#pragma once

#include <filesystem>
#include <vector>

#include <Eigen/Core>

#include "renderer/textures/texture.h"
#include "renderer/textures/texture_search.h"
#include "worlds/types.h"

namespace stereobench::renderer {

/// A triangle in the mesh's own axes and units.
struct Triangle {
  Eigen::Vector3d corners[3];
  Eigen::Vector3d normals[3];  ///< unit length, outward; the face's own where the file has none
  Eigen::Vector3d colour_rgb;  ///< the diffuse colour of its material, taken as linear light, in [0, 1]
  /// Factors on it that the file gives its corners, linear light in [0, 1]; 1 where it gives none.
  Eigen::Vector3f corner_rgb[3] = {Eigen::Vector3f::Ones(), Eigen::Vector3f::Ones(), Eigen::Vector3f::Ones()};
  int texture = -1;  ///< index into Mesh::textures; none: of one colour
  Eigen::Vector2f place_px[3] = {Eigen::Vector2f::Zero(), Eigen::Vector2f::Zero(),
                                 Eigen::Vector2f::Zero()};  ///< of the corners on its texture, column and row
};

/// What a file holds.
struct Mesh {
  std::vector<Triangle> triangles;
  std::vector<Texture> textures;
  std::vector<MissingTexture> missing_textures = {};  ///< each once; there is grey in their place
};

/// Reads all triangles of a mesh file; larger faces are cut into triangles, points and lines have no area and
/// are passed over. A child process does it, as files can crash, hang or bloat the library that reads them.
/// @param file its ending says the format: obj, dae, gltf, glb, stl or fbx
/// @return at least one triangle, coordinates of at most a million units
/// @throws std::runtime_error of one line, "file: why": another ending, unreadable, incomplete, without
///   faces, coordinates that are not finite or absurd, indices out of range, beyond a limit, or a crash
std::vector<Triangle> read_mesh(const std::filesystem::path& file, const worlds::MeshLimits& limits = {});

/// The same with the pictures that the file's materials name or hold.
/// @param folders that textures may lie in besides those that TextureFolders knows by itself
/// @throws std::runtime_error also when a picture cannot be read, or is larger than a limit
Mesh read_textured_mesh(const std::filesystem::path& file, const worlds::MeshLimits& limits = {},
                        const std::vector<std::string>& folders = {});

}  // namespace stereobench::renderer
