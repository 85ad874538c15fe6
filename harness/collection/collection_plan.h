/// What is to be rendered for a collection: a task for each drive.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "harness/collection/collection.h"
#include "harness/collection/collection_record.h"
#include "harness/collection/render_tasks.h"
#include "renderer/surfaces/mesh_cache.h"

namespace stereobench::harness {

struct CollectionPlan {
  std::vector<std::unique_ptr<const Experiment>> experiments;  ///< tasks refer to them
  std::vector<RenderTask> drives;                              ///< in the order of the file
  CollectionRecord record;
  std::shared_ptr<renderer::MeshCache> meshes;  ///< what was read of mesh files
};

/// Reads all scenarios, and checks everything that can be checked before something is rendered. The data sets
/// of a drive lie in SPLIT/NAME/seed_N, as `render --seeds` writes them to SPLIT/NAME; those of a variation
/// in SPLIT/NAME-VARIATION/seed_N.
/// @param out the collection's folder
/// @throws std::runtime_error, one line
CollectionPlan plan_collection(const Collection& collection, renderer::Backend backend,
                               const std::filesystem::path& out);

}  // namespace stereobench::harness
