/// Where the surfaces of a world end: the edges whose pixels are mixtures.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "renderer/surfaces/mesh_surfaces.h"

namespace stereobench::renderer {

/// A straight edge of one face, or of two that meet there.
struct SurfaceEdge {
  Eigen::Vector3d from_m;  ///< world frame, as the ends below
  Eigen::Vector3d to_m;
  std::array<Eigen::Vector3d, 2> inner_m;  ///< a further point of each face
  int faces = 1;
  bool is_smooth =
      false;  ///< the faces are parts of one round surface: it ends here only where one hides the other
};

/// Edges that are seen or not seen together.
struct EdgeGroup {
  std::optional<MeshRun> run;  ///< the mesh they are of; none: walls
  std::vector<SurfaceEdge> edges;
};

/// The edges of all walls and meshes. Faces meet where their corners have the same places.
std::vector<EdgeGroup> surface_edges(const worlds::World& world, const MeshSurfaces& meshes);

/// Where the floor ends for a camera: the horizon.
std::array<SurfaceEdge, 4> floor_edges(const Eigen::Vector3d& camera_m);

}  // namespace stereobench::renderer
