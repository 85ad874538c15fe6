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
using SolidReader =
    std::function<std::shared_ptr<const TriangleTree>(const World& world, const MeshInstance& mesh)>;

/// Gives each mesh of a file its solid, unless it has one.
/// @throws std::invalid_argument where there is a file, and no reader
void give_solids(World& world, const SolidReader& read);

/// The meshes of files of a world, where they stand.
class Solids {
 public:
  /// @throws std::invalid_argument when one has no solid: it would be looked through
  explicit Solids(const World& world);

  /// Whether one has a point in common with a tube.
  bool meet(const Tube& tube) const;

 private:
  struct Placed {
    std::shared_ptr<const TriangleTree> tree;
    Eigen::Affine3d world_from_tree;
  };
  std::vector<Placed> placed_;
};

}  // namespace stereobench::worlds
