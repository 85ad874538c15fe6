#include "harness/dataset/seed_render.h"

#include <algorithm>
#include <functional>
#include <memory>

#include "harness/dataset/pictures/changed_pair.h"
#include "harness/dataset/truth/frame_truth.h"
#include "harness/drive/recording.h"
#include "harness/io/atomic_file.h"
#include "harness/json/cbor.h"
#include "harness/process/kept_memory.h"
#include "harness/process/process_pool.h"
#include "harness/process/progress.h"
#include "renderer/surfaces/mesh_cache.h"
#include "worlds/scenario/scenario.h"

namespace stereobench::harness {

STEREOBENCH_ALL_FIELDS(CoarseBlur, pairs, most_step_px)
STEREOBENCH_ALL_FIELDS(WrittenDataset, pairs, was_complete, spoilt)
STEREOBENCH_ALL_FIELDS(RenderedSeed, datasets, blur)

namespace {

/// Whether some data set says what was observed.
bool looks_for_balls(const RenderTask& task) {
  return std::ranges::any_of(task.datasets,
                             [](const WantedDataset& wanted) { return wanted.format->has_sightings; });
}

std::vector<vision::BallObservation> sees_nothing(const DetectorInput&) {
  return {};
}

RenderedSeed render_seed(const RenderTask& task, const std::function<void(double)>& on_progress) {
  const worlds::Scenario& scenario = task.experiment->scenario;
  const worlds::World world = worlds::world_for_seed(scenario, task.seed);
  const DatasetDrive drive =
      changed(drive_of(scenario, world, task.seed, task.frames, task.truth), task.change);
  std::vector<DatasetOutput> outputs;
  for (const WantedDataset& wanted : task.datasets) outputs.emplace_back(wanted, drive);
  RenderedSeed rendered;
  const auto keep_outcome = [&] {
    for (const DatasetOutput& output : outputs) rendered.datasets.push_back(output.written());
    return rendered;
  };
  if (std::ranges::all_of(outputs, [](const DatasetOutput& one) { return one.written().was_complete; }))
    return keep_outcome();
  keep_freed_memory();
  renderer::MeshCache meshes;  // for the pictures and for the truth
  const bool is_linear16 = task.change.kind == PictureKind::kLinear16;
  FrameTruth truth(scenario, world, meshes.forms(), is_linear16 ? std::optional(task.seed) : std::nullopt);
  Listeners listeners;
  listeners.is_wanted = [&](std::size_t step) { return drive.steps[step].pictures.has_value(); };
  listeners.on_progress = on_progress;
  listeners.wants_fine_light = is_linear16;
  listeners.on_frame = [&](const FrameEvent& event) {
    truth.look_at(event);
    ChangedPair pair(truth, drive, task.change);
    for (DatasetOutput& output : outputs) output.write(pair);
  };
  const Recording recording = record(*task.experiment, task.seed, listeners, task.backend,
                                     looks_for_balls(task) ? Detector() : sees_nothing, meshes.forms());
  for (DatasetOutput& output : outputs) output.finish(recording.log, recording.blur);
  rendered.blur = recording.blur;
  return keep_outcome();
}

std::vector<RenderedSeed> render_in_processes(const std::vector<RenderTask>& tasks, int jobs,
                                              const OnProgress& on_progress) {
  std::vector<RenderedSeed> rendered(tasks.size());
  const auto render = [&](std::size_t index, const std::function<void(double)>& report) {
    return nlohmann::json(render_seed(tasks[index], report)).dump();
  };
  const auto keep = [&](std::size_t index, const std::string& answer) {
    rendered[index] = nlohmann::json::parse(answer).get<RenderedSeed>();
  };
  try {
    run_in_processes(tasks.size(), jobs, render, keep, on_progress);
  } catch (...) {  // the other processes were killed, maybe in the middle of a file
    for (const RenderTask& task : tasks)
      for (const WantedDataset& wanted : task.datasets)
        if (std::filesystem::exists(wanted.folder)) remove_leftovers(wanted.folder);
    throw;
  }
  return rendered;
}

}  // namespace

std::vector<RenderedSeed> render_seeds(const std::vector<RenderTask>& tasks, int jobs,
                                       const std::string& what) {
  Progress progress(what, static_cast<double>(tasks.size()));
  const auto show = [&](double done) { progress.show(done); };
  // One alone needs no process of its own: SIGTERM then ends whoever writes, file and all.
  if (tasks.size() == 1) return {render_seed(tasks.front(), show)};
  return render_in_processes(tasks, jobs, show);
}

}  // namespace stereobench::harness
