/// What is to be rendered, as tasks: a scenario, its seeds, the formats and the truth.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/dataset/formats/format_registry.h"
#include "harness/dataset/seed_render.h"

namespace stereobench::harness {

/// What somebody wants rendered of a scenario.
struct RenderRequest {
  std::filesystem::path scenario;
  std::vector<std::string> overrides;  ///< "key.path=value"
  renderer::Backend backend = renderer::Backend::kSoftware;
  std::vector<const DatasetFormat*> formats = {&dataset_formats().front()};
  TruthRequest truth;
  FrameChoice frames;  ///< as it was asked for
  PictureChange change = {};
};

/// Makes sure that there are pictures to render, that each format holds the drive, and that one of them has a
/// place for the truth.
/// @param experiment of the request's scenario
/// @throws std::runtime_error, one line
void check_request(const RenderRequest& request, const Experiment& experiment);

/// One task a seed. What a data set is told apart by (RenderedDataset) is the scenario's own text, what was
/// changed of it, the files that it names, what renders, who looks, what was asked for, and the program's
/// version. The size of balls is what `detect` is told.
/// @param experiment of the request's scenario; it outlives the tasks
/// @param out the folder; of several formats, each has one in it
/// @param has_seed_folders whether each seed has a folder of its own in that of its format: seed_3
/// @throws std::runtime_error, one line, for frames that the drive has not
std::vector<RenderTask> render_tasks(const RenderRequest& request, const Experiment& experiment,
                                     const std::vector<std::uint64_t>& seeds,
                                     const std::filesystem::path& out, bool has_seed_folders);

}  // namespace stereobench::harness
