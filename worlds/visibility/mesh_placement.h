/// Where the points of a mesh go in the world.
#pragma once

#include <Eigen/Geometry>

#include "worlds/types.h"

namespace stereobench::worlds {

/// world = position + turn * (scale * mesh), z of the mesh up.
struct MeshPlacement {
  Eigen::Matrix3d turn;
  Eigen::Vector3d scale;  ///< metres for each of the mesh's units
  Eigen::Vector3d position_m;
};

MeshPlacement placement_of(const MeshInstance& mesh);

/// From the axes of the mesh's file to the world.
Eigen::Affine3d world_from_file(const MeshInstance& mesh);

}  // namespace stereobench::worlds
