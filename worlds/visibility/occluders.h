/// Mesh files as what hides things, and is stood in by nothing.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "worlds/types.h"
#include "worlds/visibility/clearance_volume.h"

namespace stereobench::worlds {

/// Reads what a mesh of a file is made of, in the file's own axes and units: files are the business of who
/// draws them.
using OccluderReader =
    std::function<std::shared_ptr<const TriangleBvh>(const World& world, const MeshInstance& mesh)>;

/// Gives each mesh of a file its solid, unless it has one.
/// @throws std::invalid_argument where there is a file, and no reader
void give_occluders(World& world, const OccluderReader& read);

/// The meshes of files of a world, where they stand.
class Occluders {
 public:
  /// @throws std::invalid_argument when one has no solid: it would be looked through
  explicit Occluders(const World& world);

  /// Whether one has a point in common with a clearance volume.
  bool meet(const ClearanceVolume& volume) const;

 private:
  struct Placed {
    std::shared_ptr<const TriangleBvh> tree;
    Eigen::Affine3d world_from_tree;
  };
  std::vector<Placed> placed_;
};

}  // namespace stereobench::worlds
