#include "renderer/mesh_shelf.h"

namespace stereobench::renderer {
namespace {

std::shared_ptr<const worlds::TriangleTree> solid_of(const std::vector<Triangle>& triangles) {
  std::vector<worlds::TriangleCorners> corners;
  corners.reserve(triangles.size());
  for (const Triangle& t : triangles) corners.push_back({t.corners[0], t.corners[1], t.corners[2]});
  return std::make_shared<const worlds::TriangleTree>(std::move(corners));
}

}  // namespace

worlds::SolidReader MeshShelf::solids() {
  return [this](const worlds::World& world, const worlds::MeshInstance& mesh) {
    return entry(world, mesh).solid;
  };
}

FormReader MeshShelf::forms() {
  return [this](const worlds::World& world, const worlds::MeshInstance& mesh) {
    return mesh.shape == worlds::MeshShape::kFile ? entry(world, mesh).mesh : read_form(world, mesh);
  };
}

const MeshShelf::Entry& MeshShelf::entry(const worlds::World& world, const worlds::MeshInstance& mesh) {
  const Key key = {mesh.file, shows_file(world, mesh), world.mesh_limits};
  const auto known = entries_.find(key);
  if (known != entries_.end()) return known->second;
  Mesh read = read_form(world, mesh);
  auto solid = solid_of(read.triangles);
  return entries_.emplace(key, Entry{std::move(read), std::move(solid)}).first->second;
}

}  // namespace stereobench::renderer
