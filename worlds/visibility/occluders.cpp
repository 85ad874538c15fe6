#include "worlds/visibility/occluders.h"

#include <algorithm>
#include <stdexcept>

#include "worlds/visibility/mesh_placement.h"

namespace stereobench::worlds {

void give_solids(World& world, const SolidReader& read) {
  for (MeshInstance& mesh : world.meshes) {
    if (mesh.shape != MeshShape::kFile || mesh.solid) continue;
    if (!read) throw std::invalid_argument("expected a reader of mesh files: " + mesh.file);
    mesh.solid = read(world, mesh);
  }
}

Solids::Solids(const World& world) {
  for (const MeshInstance& mesh : world.meshes) {
    if (mesh.shape != MeshShape::kFile) continue;
    if (!mesh.solid) throw std::invalid_argument("expected the solid of " + mesh.file);
    placed_.push_back({mesh.solid, world_from_file(mesh)});
  }
}

bool Solids::meet(const Tube& tube) const {
  return std::ranges::any_of(
      placed_, [&](const Placed& solid) { return meets(tube, *solid.tree, solid.world_from_tree); });
}

}  // namespace stereobench::worlds
