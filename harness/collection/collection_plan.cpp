#include "harness/collection/collection_plan.h"

#include "harness/experiment/experiment.h"

namespace stereobench::harness {
namespace {

/// What is rendered of a variation.
RenderRequest request_of(const Collection& collection, const DriveGroup& drives,
                         const DriveVariation& variation, renderer::Backend backend) {
  RenderRequest request = {.scenario = drives.scenario,
                           .overrides = drives.set,
                           .backend = backend,
                           .formats = collection.formats,
                           .truth = collection.truth,
                           .frames = drives.frames,
                           .change = collection.change};
  request.overrides.insert(request.overrides.end(), variation.set.begin(), variation.set.end());
  return request;
}

void add_drives(const DriveGroup& drives, const DriveVariation& variation, const RenderRequest& request,
                const std::filesystem::path& out, CollectionPlan& plan) {
  const Experiment& experiment = *plan.experiments.back();
  for (const Split split : kSplits) {
    const std::filesystem::path folder = out / name_of(split) / folder_name(drives, variation);
    const auto& seeds = drives.seeds_of.at(static_cast<std::size_t>(split));
    for (RenderTask& task : render_tasks(request, experiment, seeds, folder, true)) {
      for (const WantedDataset& wanted : task.datasets)
        plan.record.datasets.push_back(
            {.folder = wanted.folder.lexically_relative(out).generic_string(),
             .split = std::string(name_of(split)),
             .name = drives.name,
             .variation = variation.name,
             .format = std::string(wanted.format->name),
             .scenario = experiment.scenario.name,
             .seed = task.seed,
             .identity_sha256 = identity_hash(nlohmann::json::parse(wanted.identity.dump()))});
      plan.drives.push_back(std::move(task));
    }
  }
}

}  // namespace

CollectionPlan plan_collection(const Collection& collection, renderer::Backend backend,
                               const std::filesystem::path& out) {
  CollectionPlan plan;
  plan.meshes = std::make_shared<renderer::MeshCache>();
  plan.record = {
      .name = collection.name, .version = STEREOBENCH_VERSION, .about = collection.about, .datasets = {}};
  for (const DriveGroup& drives : collection.drives)
    for (const DriveVariation& variation : drives.variations) {
      const RenderRequest request = request_of(collection, drives, variation, backend);
      plan.experiments.push_back(std::make_unique<const Experiment>(
          read_experiment(request.scenario, request.overrides, plan.meshes->occluders())));
      check_request(request, *plan.experiments.back());
      add_drives(drives, variation, request, out, plan);
    }
  return plan;
}

}  // namespace stereobench::harness
