#include "harness/drive/recording.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "harness/detector/detector_process.h"
#include "harness/detector/detector_registry.h"
#include "harness/detector_faults/faulty_detector.h"
#include "harness/drive/detection_stage.h"
#include "harness/drive/drive_log.h"
#include "harness/drive/perfect_detections.h"
#include "harness/drive/stereo_camera.h"
#include "harness/process/stopwatch.h"
#include "renderer/camera/expose.h"
#include "renderer/renderer.h"
#include "slam/math/random.h"
#include "worlds/oracle.h"
#include "worlds/scenario/scenario.h"

namespace stereobench::harness {
namespace {

constexpr const char* kOurs = "stereobench";
constexpr const char* kCallable = "callable";

/// Shows an onlooker's detector what was taken, and scores what that finds; lives as long as the drive.
class StereoOnlooker {
 public:
  StereoOnlooker(const Onlooker& onlooker, const worlds::World& world, const StreamSeeds& seeds)
      : onlooker_(onlooker),
        world_(world),
        name_(kCallable),
        stage_(*onlooker.experiment, world, seeds.sensor) {
    const Experiment& experiment = *onlooker.experiment;
    const DetectorSetup setup = detector_setup(experiment.scenario);
    detector_ = onlooker.detector;
    if (detector_) return;
    name_ = experiment.detector.command.empty() ? kOurs : experiment.detector.command;
    if (const DetectorKind* const linked = find_detector(name_)) {
      detector_ = linked->make(setup);
      return;
    }
    program_.emplace(experiment.detector, setup, fmt::format("seed {}", seeds.world));
    detector_ = std::ref(*program_);
  }

  /// Also what a late detector needs for its answer at a step that is wanted.
  bool wants(std::size_t index) const {
    const std::size_t arrival = index + stage_.latency_frames();
    const auto& is_wanted = onlooker_.listeners.is_wanted;
    return is_wanted(index) || (arrival < onlooker_.experiment->scenario.path.size() && is_wanted(arrival));
  }

  Sightings see(const worlds::PathStep& step, std::size_t index, const TakenPair& taken,
                renderer::Renderer& renderer) {
    Stopwatch watch(result_.recording.timing);
    const worlds::Scenario& scenario = onlooker_.experiment->scenario;
    auto observations = watch.time("observe", [&] {
      return detector_({index, step.stamp_ns, taken.pair, scenario.believed_rig});
    });
    const VisionTruth truth{world_, scenario.rig, step.pose, taken.exposed.frame};
    const ArrivedDetections arrived = stage_.arriving(index, ball_outlines(truth), std::move(observations));
    if (!onlooker_.listeners.is_wanted(index)) return {};
    result_.recording.blur.add(taken.exposed.blur_step_px);
    Sightings sightings = stage_.take(arrived);
    onlooker_.listeners.on_frame({index, step.stamp_ns, step.pose, taken.exposed.frame, taken.pair,
                                  arrived.observations, arrived.match, world_, scenario.rig, taken.late_s,
                                  &renderer});
    return sightings;
  }

  void finish() {
    if (program_) program_->finish();
    result_.recording.detector = name_;
    result_.recording.vision = stage_.score();
    result_.recording.faults = stage_.fault_counts();
  }

  OnlookerResult& result() { return result_; }

 private:
  const Onlooker& onlooker_;
  const worlds::World& world_;
  std::string name_;
  std::optional<DetectorProcess> program_;
  Detector detector_;
  DetectionStage stage_;
  OnlookerResult result_;
};

/// The light that the cameras and the onlookers need.
renderer::LightDepth light_of(const std::vector<Onlooker>& onlookers) {
  const bool is_fine = std::ranges::any_of(
      onlookers, [](const Onlooker& onlooker) { return onlooker.listeners.wants_fine_light; });
  return is_fine ? renderer::LightDepth::kSixteenBits
                 : renderer::light_for(onlookers.front().experiment->scenario.camera);
}

void put(Sightings seen, LogStep& step) {
  step.measurements = std::move(seen.measurements);
  step.true_landmarks = std::move(seen.balls);
}

/// What is sensed without pictures.
OnlookerResult sense_drive(const Onlooker& onlooker, const worlds::World& world, const StreamSeeds& seeds) {
  const worlds::Scenario& scenario = onlooker.experiment->scenario;
  const std::uint64_t seed = seeds.sensor;
  OnlookerResult look;
  look.recording.log = log_without_sightings(scenario, world, seeds.odometry);
  std::vector<LogStep>& steps = look.recording.log.steps;
  std::optional<FaultyDetector> faults;
  const PerfectDetections& perfect = onlooker.experiment->perfect_detections;
  if (const auto& named = onlooker.experiment->detector_noise)
    faults.emplace(without_perfect(perfect, *named), scenario, world, seed);
  for (std::size_t index = 0; index < steps.size(); ++index) {
    slam::RandomStream noise(seed, slam::Stream::kOracle, index);
    slam::RandomStream chance(seed, slam::Stream::kClutter, index);
    const slam::Pose& pose = scenario.path[index].pose;
    const Sightings all = worlds::sense(world, pose, scenario.oracle, scenario.identity, noise);
    std::vector<TracedDetection> detections = traced(
        perfect.places ? all : worlds::with_faults(all, world, scenario.oracle, scenario.identity, chance));
    if (faults) detections = faults->worsen(index, std::move(detections));
    if (perfect.places) put_at_true_places(world, pose, detections);
    if (faults) detections = faults->delay(index, std::move(detections));
    Sightings sensed = oracle_sightings(detections);
    if (perfect.names) tell_names(sensed);
    put(std::move(sensed), steps[index]);
    onlooker.listeners.on_progress(static_cast<double>(index + 1) / static_cast<double>(steps.size()));
  }
  if (faults) look.recording.faults = faults->counts();
  return look;
}

/// Lets one that is not at fault do something; a fault of its program is kept.
void attempt(StereoOnlooker& onlooker, const std::function<void()>& action) {
  if (onlooker.result().fault) return;
  try {
    action();
  } catch (const DetectorFault&) {
    onlooker.result().fault = std::current_exception();
  }
}

/// The pictures of a drive, each taken once and shown to each onlooker that wants it.
class SharedDrive {
 public:
  SharedDrive(const std::vector<Onlooker>& onlookers, const worlds::World& world, const StreamSeeds& seeds,
              renderer::Backend backend, const renderer::FormReader& read)
      : scenario_(onlookers.front().experiment->scenario),
        camera_(scenario_, world, seeds.sensor, backend, light_of(onlookers), read) {
    for (const Onlooker& onlooker : onlookers) {
      onlookers_.push_back(std::make_unique<StereoOnlooker>(onlooker, world, seeds));
      onlookers_.back()->result().recording.log =
          log_without_sightings(onlooker.experiment->scenario, world, seeds.odometry);
    }
  }

  void show(std::size_t index) {
    const auto wants_it = [&](const auto& onlooker) {
      return !onlooker->result().fault && onlooker->wants(index);
    };
    const auto wanting = std::ranges::count_if(onlookers_, wants_it);
    if (wanting == 0) return;
    Timing taking;
    const std::optional<TakenPair> taken = camera_.take(index, taking);
    for (const auto& onlooker : onlookers_) {
      if (!wants_it(onlooker)) continue;
      Recording& recording = onlooker->result().recording;
      for (const auto& [stage, seconds] : taking)
        recording.timing[stage] += seconds / static_cast<double>(wanting);
      if (taken)
        attempt(*onlooker, [&] {
          put(onlooker->see(scenario_.path[index], index, *taken, camera_.renderer()),
              recording.log.steps[index]);
        });
    }
  }

  bool is_over() const {
    return std::ranges::all_of(onlookers_, [](const auto& one) { return one->result().fault != nullptr; });
  }

  std::vector<OnlookerResult> finish() {
    std::vector<OnlookerResult> looks;
    for (const auto& onlooker : onlookers_) {
      attempt(*onlooker, [&] { onlooker->finish(); });
      looks.push_back(std::move(onlooker->result()));
    }
    return looks;
  }

 private:
  const worlds::Scenario& scenario_;
  StereoCamera camera_;
  std::vector<std::unique_ptr<StereoOnlooker>> onlookers_;
};

}  // namespace

std::vector<OnlookerResult> record_together(const std::vector<Onlooker>& onlookers, const StreamSeeds& seeds,
                                            renderer::Backend backend, const renderer::FormReader& read) {
  const worlds::Scenario& scenario = onlookers.front().experiment->scenario;
  const worlds::World world = worlds::world_for_seed(scenario, seeds.world);
  std::vector<OnlookerResult> looks;
  if (scenario.sensor == worlds::SensorKind::kOracle) {
    for (const Onlooker& onlooker : onlookers) looks.push_back(sense_drive(onlooker, world, seeds));
    return looks;
  }
  SharedDrive drive(onlookers, world, seeds, backend, read);
  for (std::size_t index = 0; index < scenario.path.size() && !drive.is_over(); ++index) {
    drive.show(index);
    onlookers.front().listeners.on_progress(static_cast<double>(index + 1) /
                                            static_cast<double>(scenario.path.size()));
  }
  return drive.finish();
}

Recording record(const Experiment& experiment, const StreamSeeds& seeds, const Listeners& listeners,
                 renderer::Backend backend, const Detector& detector, const renderer::FormReader& read) {
  OnlookerResult look =
      std::move(record_together({{&experiment, listeners, detector}}, seeds, backend, read).front());
  if (look.fault) std::rethrow_exception(look.fault);
  return std::move(look.recording);
}

}  // namespace stereobench::harness
