/// Mesh files read by hand, for tests of worlds: obj with vertices and faces alone.
#pragma once

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "worlds/visibility/occluders.h"

namespace stereobench::worlds {

inline std::shared_ptr<const TriangleBvh> read_obj(const std::string& file) {
  std::ifstream lines(file);
  std::vector<Eigen::Vector3d> vertices;
  std::vector<TriangleCorners> triangles;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    Eigen::Vector3d vertex;
    if (kind == "v" && words >> vertex.x() >> vertex.y() >> vertex.z()) vertices.push_back(vertex);
    std::vector<Eigen::Vector3d> face;
    for (std::string corner; kind == "f" && words >> corner;)
      face.push_back(vertices.at(static_cast<std::size_t>(std::stoi(corner)) - 1));
    for (std::size_t i = 2; i < face.size(); ++i) triangles.push_back({face[0], face[i - 1], face[i]});
  }
  if (triangles.empty()) throw std::runtime_error(file + ": no faces");
  return std::make_shared<const TriangleBvh>(triangles);
}

inline std::shared_ptr<const TriangleBvh> obj_solid(const World&, const MeshInstance& mesh) {
  return read_obj(mesh.file);
}

/// A cube with sides of 1 on the floor around its origin.
inline const std::string kCube =
    "v -0.5 -0.5 0\nv 0.5 -0.5 0\nv 0.5 0.5 0\nv -0.5 0.5 0\nv -0.5 -0.5 1\nv 0.5 -0.5 1\nv 0.5 0.5 1\n"
    "v -0.5 0.5 1\nf 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

}  // namespace stereobench::worlds
