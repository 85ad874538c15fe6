/// A small mesh in a room, as the renderer reads it and as rays meet it.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "renderer/meshes/mesh_file.h"
#include "tests/renderer/folder.h"
#include "worlds/types.h"

namespace stereobench::renderer::test {

/// Puts a tetrahedron, turned and stretched, into a world.
/// @return its triangles in the world frame
inline std::vector<Triangle> add_wedge(worlds::World& world) {
  const std::string file = folder_of_this_process().write(
      "wedge.obj", "v 0 0 0\nv 1 0 0\nv 0 0.5 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  const Eigen::Vector3d place(1.6, 0.2, 0.1);
  const Eigen::Vector3d scale(0.5, 1.5, 0.6);
  world.meshes.push_back({file, place, 0.8, scale, worlds::Material::kPlain});
  std::vector<Triangle> triangles = read_mesh(file);
  for (Triangle& triangle : triangles) {
    for (Eigen::Vector3d& corner : triangle.corners) {
      corner = place + Eigen::AngleAxisd(0.8, Eigen::Vector3d::UnitZ()) * scale.cwiseProduct(corner);
      corner = corner.cast<float>().cast<double>();  // what GL is given
    }
  }
  return triangles;
}

}  // namespace stereobench::renderer::test
