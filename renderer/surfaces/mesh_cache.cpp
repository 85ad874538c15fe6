#include "renderer/surfaces/mesh_cache.h"

#include <set>

namespace stereobench::renderer {
namespace {

std::shared_ptr<const worlds::TriangleBvh> occluder_of(const std::vector<Triangle>& triangles) {
  std::vector<worlds::TriangleCorners> corners;
  corners.reserve(triangles.size());
  for (const Triangle& t : triangles) corners.push_back({t.corners[0], t.corners[1], t.corners[2]});
  return std::make_shared<const worlds::TriangleBvh>(corners);
}

}  // namespace

worlds::OccluderReader MeshCache::occluders() {
  return [this](const worlds::World& world, const worlds::MeshInstance& mesh) {
    return entry(world, mesh).occluder;
  };
}

FormReader MeshCache::forms() {
  return [this](const worlds::World& world, const worlds::MeshInstance& mesh) {
    return mesh.shape == worlds::MeshShape::kFile ? entry(world, mesh).mesh : read_form(world, mesh);
  };
}

std::vector<std::string> MeshCache::missing_textures(const worlds::World& world) {
  std::set<std::string> lines;
  for (const worlds::MeshInstance& mesh : world.meshes) {
    if (mesh.shape != worlds::MeshShape::kFile || !shows_file(world, mesh)) continue;
    const auto& missing = entry(world, mesh).mesh.missing_textures;
    if (!missing.empty()) lines.insert(mesh.file + ": " + complaint(missing));
  }
  return {lines.begin(), lines.end()};
}

const MeshCache::Entry& MeshCache::entry(const worlds::World& world, const worlds::MeshInstance& mesh) {
  const Key key = {mesh.file, shows_file(world, mesh), world.mesh_limits, world.texture_search.folders};
  const auto known = entries_.find(key);
  if (known != entries_.end()) return known->second;
  Mesh read = read_form(world, mesh);
  auto occluder = occluder_of(read.triangles);
  return entries_.emplace(key, Entry{std::move(read), std::move(occluder)}).first->second;
}

}  // namespace stereobench::renderer
