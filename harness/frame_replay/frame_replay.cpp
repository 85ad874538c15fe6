#include "harness/frame_replay/frame_replay.h"

#include <map>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/detector/detector_registry.h"
#include "harness/experiment/experiment.h"
#include "harness/page/command_words.h"
#include "harness/vision_scoring/detection_table.h"

namespace stereobench::harness {
namespace {

using Steps = std::set<std::size_t>;

ReplayedFrame replayed(std::uint64_t seed, const FrameEvent& event, const worlds::CameraSensor& camera) {
  return {.name = {seed, event.step},
          .world = event.world,
          .rig = event.rig,
          .camera = camera,
          .pair = {event.pair.left.clone(), event.pair.right.clone()},
          .truth = event.frame,
          .observations = event.observations,
          .match = event.match,
          .rows = detection_rows({seed, event.step, event.world, event.rig}, event.match)};
}

/// The steps of one seed.
std::vector<ReplayedFrame> replay_seed(const Experiment& experiment, std::uint64_t seed, const Steps& steps,
                                       renderer::Backend backend, renderer::MeshCache& meshes,
                                       bool with_before) {
  std::vector<ReplayedFrame> frames;
  Listeners listeners;
  listeners.is_wanted = [&](std::size_t step) {
    return with_before ? step <= *steps.rbegin() : steps.contains(step);
  };
  listeners.on_frame = [&](const FrameEvent& event) {
    if (steps.contains(event.step)) frames.push_back(replayed(seed, event, experiment.scenario.camera));
  };
  record(experiment, seed, listeners, backend, {}, meshes.forms());
  auto seen = frames.begin();
  for (const std::size_t step : steps) {
    if (seen == frames.end() || seen->name.step != step) refuse_dropped({seed, step});
    ++seen;
  }
  return frames;
}

}  // namespace

void require_frame(const worlds::Scenario& scenario, const FrameName& frame) {
  if (scenario.sensor != worlds::SensorKind::kStereo)
    throw std::runtime_error(
        fmt::format("the sensor of {} is the oracle, which has no pictures", scenario.name));
  if (frame.step >= scenario.path.size())
    throw std::runtime_error(fmt::format("the drive of {} has the steps 0 to {} (got {})", scenario.name,
                                         scenario.path.size() - 1, frame.step));
}

void refuse_dropped(const FrameName& frame) {
  throw std::runtime_error(fmt::format("seed {} step {}: the shutter drops this frame, it has no pictures",
                                       frame.seed, frame.step));
}

Experiment experiment_of(const Invocation& invocation, renderer::MeshCache& meshes) {
  Experiment experiment = read_experiment(invocation.scenario, invocation.overrides, meshes.occluders());
  std::string& command = experiment.detector.command;
  const bool is_program = !command.empty() && find_detector(command) == nullptr;
  if (is_program && std::filesystem::is_directory(invocation.folder))
    command = fmt::format("cd {} && {}", shell_word(invocation.folder.string()), command);
  return experiment;
}

std::vector<ReplayedFrame> replay_frames(const Experiment& experiment, std::span<const FrameName> frames,
                                         renderer::Backend backend, renderer::MeshCache& meshes,
                                         bool with_before) {
  std::map<std::uint64_t, Steps> steps_of_seeds;
  for (const FrameName& frame : frames) {
    require_frame(experiment.scenario, frame);
    steps_of_seeds[frame.seed].insert(frame.step);
  }
  std::vector<ReplayedFrame> replayed_frames;
  for (const auto& [seed, steps] : steps_of_seeds)
    for (ReplayedFrame& frame : replay_seed(experiment, seed, steps, backend, meshes, with_before))
      replayed_frames.push_back(std::move(frame));
  return replayed_frames;
}

std::vector<ReplayedFrame> replay_frames(const Invocation& invocation, std::span<const FrameName> frames,
                                         bool with_before) {
  renderer::MeshCache meshes;
  const Experiment experiment = experiment_of(invocation, meshes);
  return replay_frames(experiment, frames, invocation.backend, meshes, with_before);
}

}  // namespace stereobench::harness
