/// Mesh files that were read, for all that need them before anything is rendered.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "renderer/surfaces/mesh_surfaces.h"
#include "worlds/visibility/occluders.h"

namespace stereobench::renderer {

/// Reads each file once, whoever asks. What it hands out asks it, and must not outlive it.
class MeshCache {
 public:
  /// For the reader of scenarios. @throws std::runtime_error as read_form
  worlds::OccluderReader occluders();

  /// For place_meshes. @throws std::runtime_error as read_form
  FormReader forms();

  /// The textures of a world's meshes that are nowhere, a line for each file that names some.
  /// @throws std::runtime_error as read_form
  std::vector<std::string> missing_textures(const worlds::World& world);

 private:
  /// A file, whether it is read with its textures, what it may cost, and where its textures may lie.
  using Key = std::tuple<std::string, bool, worlds::MeshLimits, std::vector<std::string>>;
  struct Entry {
    Mesh mesh;
    std::shared_ptr<const worlds::TriangleBvh> occluder;
  };
  const Entry& entry(const worlds::World& world, const worlds::MeshInstance& mesh);

  std::map<Key, Entry> entries_;
};

}  // namespace stereobench::renderer
