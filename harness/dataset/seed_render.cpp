#include "harness/dataset/seed_render.h"

#include <functional>

#include "harness/dataset/frame_truth.h"
#include "harness/dataset/rendered_dataset.h"
#include "harness/drive/recording.h"
#include "harness/io/atomic_file.h"
#include "harness/json/cbor.h"
#include "harness/process/process_pool.h"
#include "harness/process/progress.h"
#include "renderer/surfaces/mesh_cache.h"
#include "worlds/scenario/scenario.h"

namespace stereobench::harness {

STEREOBENCH_ALL_FIELDS(CoarseBlur, pairs, most_step_px)
STEREOBENCH_ALL_FIELDS(RenderedSeed, pairs, was_complete, spoilt, blur)

namespace {

RenderedSeed render_seed(const RenderTask& task, const std::function<void(double)>& on_progress) {
  const worlds::Scenario& scenario = task.experiment->scenario;
  RenderedDataset dataset(task.folder, task.identity);
  if (dataset.is_complete()) return {.was_complete = true};
  RenderedSeed rendered = {.spoilt = dataset.spoilt()};
  const worlds::World world = worlds::world_for_seed(scenario, task.seed);
  renderer::MeshCache meshes;  // for the pictures and for the truth
  FrameTruth truth(scenario, world, meshes.forms());
  const auto writer = task.format->make({scenario, world, task.seed, task.frames, task.truth});
  Listeners listeners;
  listeners.is_wanted = [&](std::size_t step) { return task.frames.has(step); };
  listeners.on_progress = on_progress;
  listeners.on_frame = [&](const FrameEvent& event) {
    truth.look_at(event);
    dataset.write(event.step, writer->frame_files(event, truth));
    ++rendered.pairs;
  };
  const Recording recording =
      record(*task.experiment, task.seed, listeners, task.backend, {}, meshes.forms());
  rendered.blur = recording.blur;
  dataset.finish(writer->drive_files(recording.log), recording.blur);
  return rendered;
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
      if (std::filesystem::exists(task.folder)) remove_leftovers(task.folder);
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
