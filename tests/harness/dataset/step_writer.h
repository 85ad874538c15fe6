/// Single steps of a drive as data sets hold them, without the rest of the drive.
#pragma once

#include <memory>

#include "harness/dataset/formats/format_registry.h"
#include "harness/dataset/rendered_dataset.h"
#include "harness/dataset/truth/frame_truth.h"
#include "tests/test_folder.h"

namespace stereobench::harness {

/// Three steps in a room with two balls, one behind the other.
inline worlds::Scenario room_drive() {
  worlds::Scenario scenario;
  scenario.name = "room";
  scenario.rig.intrinsics = {160, 120, 140.0, 79.5, 59.5};
  scenario.believed_rig = scenario.rig;
  scenario.world.balls = {{{2.0, 0.1, 0.3}, 0.1, 3}, {{2.6, 0.1, 0.3}, 0.1, 5}};
  scenario.world.walls = {{{4.0, -3.0}, {4.0, 3.0}, 2.5, worlds::Material::kPlaster}};
  for (int i = 0; i < 3; ++i) {
    const slam::Pose pose{0.1 * i, 0.0, 0.05 * i};
    scenario.path.push_back({i * 100'000'000LL, pose, {{1.0, 0.5, 0.1}}});
  }
  scenario.path.front().controls.clear();
  return scenario;
}

/// Writes what it is shown in a format.
class StepWriter {
 public:
  /// @param scenario outlives it
  StepWriter(const TestFolder& folder, const worlds::Scenario& scenario, const DatasetFormat& format,
             const TruthRequest& request)
      : scenario_(scenario),
        renderer_(scenario.world, scenario.rig),
        truth_(scenario, scenario.world, renderer::read_form),
        drive_(drive_of(scenario, scenario.world, 0, {}, request)),
        writer_(format.make(drive_)),
        dataset_(folder.path(), {{"seed", 0}}) {}

  void write(std::size_t step, const renderer::StereoFrame& seen, double late_s = 0.0) {
    const FrameEvent event = {.step = step,
                              .frame = seen,
                              .pair = {seen.left.colour, seen.right.colour},
                              .observations = {},
                              .match = {},
                              .world = scenario_.world,
                              .rig = scenario_.rig,
                              .late_s = late_s,
                              .renderer = &renderer_};
    truth_.look_at(event);
    dataset_.write(step, writer_->frame_files(truth_));
  }
  void finish() {
    MeasurementLog log = {.start = scenario_.path.front().pose, .steps = {}, .landmarks = {}};
    for (const worlds::PathStep& step : scenario_.path)
      log.steps.push_back({.stamp_ns = step.stamp_ns, .odometry = step.controls, .truth = step.pose});
    dataset_.finish(writer_->drive_files(log), {}, writer_->containers(log));
  }

 private:
  const worlds::Scenario& scenario_;
  renderer::Renderer renderer_;
  FrameTruth truth_;
  DatasetDrive drive_;
  std::unique_ptr<DatasetWriter> writer_;
  RenderedDataset dataset_;
};

}  // namespace stereobench::harness
