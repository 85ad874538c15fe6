#include "worlds/visibility/occluders.h"

#include <algorithm>
#include <stdexcept>

#include "worlds/visibility/mesh_placement.h"

namespace stereobench::worlds {

void give_occluders(World& world, const OccluderReader& read) {
  for (MeshInstance& mesh : world.meshes) {
    if (mesh.shape != MeshShape::kFile || mesh.occluder) continue;
    if (!read) throw std::invalid_argument("expected a reader of mesh files: " + mesh.file);
    mesh.occluder = read(world, mesh);
  }
}

Occluders::Occluders(const World& world) {
  for (const MeshInstance& mesh : world.meshes) {
    if (mesh.shape != MeshShape::kFile) continue;
    if (!mesh.occluder) throw std::invalid_argument("expected the solid of " + mesh.file);
    placed_.push_back({mesh.occluder, world_from_file(mesh)});
  }
}

bool Occluders::meet(const ClearanceVolume& volume) const {
  return std::ranges::any_of(placed_, [&](const Placed& occluder) {
    return meets(volume, *occluder.tree, occluder.world_from_tree);
  });
}

}  // namespace stereobench::worlds
