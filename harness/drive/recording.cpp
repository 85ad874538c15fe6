#include "harness/drive/recording.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "harness/detector/detector_process.h"
#include "harness/detector/detector_registry.h"
#include "harness/detector_faults/faulty_detector.h"
#include "harness/drive/shutter.h"
#include "harness/drive/sightings.h"
#include "harness/process/stopwatch.h"
#include "renderer/camera/expose.h"
#include "renderer/renderer.h"
#include "slam/math/random.h"
#include "slam/models/motion.h"
#include "worlds/oracle.h"
#include "worlds/scenario/scenario.h"

namespace stereobench::harness {
namespace {

constexpr const char* kOurs = "stereobench";
constexpr const char* kCallable = "callable";

/// A pair as it was taken, with the truth behind it.
struct TakenPair {
  ExposedFrame exposed;
  vision::StereoPair pair;
  double late_s = 0.0;
};

/// Renders and exposes pairs; lives as long as the drive.
class StereoCamera {
 public:
  StereoCamera(const worlds::Scenario& scenario, const worlds::World& world, std::uint64_t seed,
               renderer::Backend backend, renderer::LightDepth light, const renderer::FormReader& read)
      : scenario_(scenario), seed_(seed), renderer_(world, scenario.rig, backend, light, read) {}

  /// @return empty where the frame is lost
  std::optional<TakenPair> take(std::size_t index, Timing& timing) {
    Stopwatch watch(timing);
    const std::optional<double> late_s = lateness_s(scenario_.shutter, seed_, index);
    if (!late_s) return {};
    TakenPair taken{.late_s = *late_s};
    taken.exposed = watch.time(
        "render", [&] { return open_shutter(renderer_, scenario_.path, index, scenario_.shutter, *late_s); });
    taken.pair = watch.time(
        "expose", [&] { return renderer::expose(taken.exposed.frame, scenario_.camera, seed_, index); });
    return taken;
  }

  renderer::Renderer& renderer() { return renderer_; }

 private:
  const worlds::Scenario& scenario_;
  std::uint64_t seed_;
  renderer::Renderer renderer_;
};

/// Shows an onlooker's detector what was taken, and scores what that finds; lives as long as the drive.
class StereoOnlooker {
 public:
  StereoOnlooker(const Onlooker& onlooker, const worlds::World& world, std::uint64_t seed)
      : onlooker_(onlooker), world_(world), name_(kCallable) {
    const Experiment& experiment = *onlooker.experiment;
    if (experiment.detector_noise)
      faults_.emplace(*experiment.detector_noise, experiment.scenario, world, seed);
    const DetectorSetup setup = detector_setup(experiment.scenario);
    detector_ = onlooker.detector;
    if (detector_) return;
    name_ = experiment.detector.command.empty() ? kOurs : experiment.detector.command;
    if (const DetectorKind* const linked = find_detector(name_)) {
      detector_ = linked->make(setup);
      return;
    }
    program_.emplace(experiment.detector, setup, fmt::format("seed {}", seed));
    detector_ = std::ref(*program_);
  }

  /// Also what a late detector needs for its answer at a step that is wanted.
  bool wants(std::size_t index) const {
    const std::size_t arrival = index + (faults_ ? faults_->latency_frames() : 0);
    const auto& is_wanted = onlooker_.listeners.is_wanted;
    return is_wanted(index) || (arrival < onlooker_.experiment->scenario.path.size() && is_wanted(arrival));
  }

  Sightings see(const worlds::PathStep& step, std::size_t index, const TakenPair& taken,
                renderer::Renderer& renderer) {
    Stopwatch watch(result_.recording.timing);
    const worlds::Scenario& scenario = onlooker_.experiment->scenario;
    const VisionTruth truth{world_, scenario.rig, step.pose, taken.exposed.frame};
    auto observations = watch.time("observe", [&] {
      return detector_({index, step.stamp_ns, taken.pair, scenario.believed_rig});
    });
    std::optional<std::vector<int>> balls;
    if (faults_) balls = make_worse(truth, index, observations);
    if (!onlooker_.listeners.is_wanted(index)) return {};
    result_.recording.blur.add(taken.exposed.blur_step_px);
    const FrameMatch match = match_observations(truth, observations);
    score_ += score_match(match);
    const worlds::World& meant = scenario.world;
    score_.rig +=
        check_rig(scenario.believed_rig, {meant.ball_radius_m(), meant.ball_radius_sd_m}, observations);
    onlooker_.listeners.on_frame({index, step.stamp_ns, step.pose, taken.exposed.frame, taken.pair,
                                  observations, match, world_, scenario.rig, taken.late_s, &renderer});
    return sightings_of(observations, balls ? *balls : balls_observed(match), world_.balls,
                        scenario.identity);
  }

  void finish() {
    if (program_) program_->finish();
    result_.recording.detector = name_;
    result_.recording.vision = score_;
    if (faults_) result_.recording.faults = faults_->counts();
  }

  OnlookerResult& result() { return result_; }

 private:
  /// Puts the detector's faults into what it found.
  /// @return the balls that the detections are of, wherever those lie now
  std::vector<int> make_worse(const VisionTruth& truth, std::size_t index,
                              std::vector<vision::BallObservation>& observations) {
    const std::vector<TracedDetection> arriving =
        faults_->arriving(index, traced(observations, match_observations(truth, observations)));
    observations = observations_of(arriving);
    return balls_of(arriving);
  }

  const Onlooker& onlooker_;
  const worlds::World& world_;
  std::string name_;
  std::optional<DetectorProcess> program_;
  Detector detector_;
  std::optional<FaultyDetector> faults_;
  VisionScore score_;
  OnlookerResult result_;
};

std::vector<LandmarkTruth> landmarks_of(const worlds::World& world) {
  std::vector<LandmarkTruth> landmarks;
  for (std::size_t i = 0; i < world.balls.size(); ++i)
    landmarks.push_back({static_cast<int>(i), world.balls[i].colour, world.balls[i].centre_m.head<2>()});
  return landmarks;
}

std::vector<slam::Control> measured_odometry(const std::vector<slam::Control>& controls,
                                             const slam::OdometryNoise& noise, slam::RandomStream& stream) {
  std::vector<slam::Control> measured;
  for (const slam::Control& control : controls) measured.push_back(slam::perturb(control, noise, stream));
  return measured;
}

/// A log with all that is not sensed.
MeasurementLog log_without_sightings(const worlds::Scenario& scenario, const worlds::World& world,
                                     std::uint64_t seed) {
  MeasurementLog log;
  log.landmarks = landmarks_of(world);
  if (!scenario.path.empty()) log.start = scenario.path.front().pose;
  slam::RandomStream odometry_stream(seed, slam::Stream::kOdometry);
  for (const worlds::PathStep& step : scenario.path)
    log.steps.push_back(
        {.stamp_ns = step.stamp_ns,
         .odometry = measured_odometry(step.controls, scenario.odometry_noise, odometry_stream),
         .truth = step.pose});
  return log;
}

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
OnlookerResult sense_drive(const Onlooker& onlooker, const worlds::World& world, std::uint64_t seed) {
  const worlds::Scenario& scenario = onlooker.experiment->scenario;
  OnlookerResult look;
  look.recording.log = log_without_sightings(scenario, world, seed);
  std::vector<LogStep>& steps = look.recording.log.steps;
  std::optional<FaultyDetector> faults;
  if (const auto& named = onlooker.experiment->detector_noise) faults.emplace(*named, scenario, world, seed);
  for (std::size_t index = 0; index < steps.size(); ++index) {
    slam::RandomStream noise(seed, slam::Stream::kOracle, index);
    slam::RandomStream chance(seed, slam::Stream::kClutter, index);
    const Sightings all =
        worlds::sense(world, scenario.path[index].pose, scenario.oracle, scenario.identity, noise);
    Sightings sensed = worlds::with_faults(all, world, scenario.oracle, scenario.identity, chance);
    if (faults) sensed = oracle_sightings(faults->arriving(index, traced(sensed)));
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
  SharedDrive(const std::vector<Onlooker>& onlookers, const worlds::World& world, std::uint64_t seed,
              renderer::Backend backend, const renderer::FormReader& read)
      : scenario_(onlookers.front().experiment->scenario),
        camera_(scenario_, world, seed, backend, light_of(onlookers), read) {
    for (const Onlooker& onlooker : onlookers) {
      onlookers_.push_back(std::make_unique<StereoOnlooker>(onlooker, world, seed));
      onlookers_.back()->result().recording.log =
          log_without_sightings(onlooker.experiment->scenario, world, seed);
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

std::vector<OnlookerResult> record_together(const std::vector<Onlooker>& onlookers, std::uint64_t seed,
                                            renderer::Backend backend, const renderer::FormReader& read) {
  const worlds::Scenario& scenario = onlookers.front().experiment->scenario;
  const worlds::World world = worlds::world_for_seed(scenario, seed);
  std::vector<OnlookerResult> looks;
  if (scenario.sensor == worlds::SensorKind::kOracle) {
    for (const Onlooker& onlooker : onlookers) looks.push_back(sense_drive(onlooker, world, seed));
    return looks;
  }
  SharedDrive drive(onlookers, world, seed, backend, read);
  for (std::size_t index = 0; index < scenario.path.size() && !drive.is_over(); ++index) {
    drive.show(index);
    onlookers.front().listeners.on_progress(static_cast<double>(index + 1) /
                                            static_cast<double>(scenario.path.size()));
  }
  return drive.finish();
}

Recording record(const Experiment& experiment, std::uint64_t seed, const Listeners& listeners,
                 renderer::Backend backend, const Detector& detector, const renderer::FormReader& read) {
  OnlookerResult look =
      std::move(record_together({{&experiment, listeners, detector}}, seed, backend, read).front());
  if (look.fault) std::rethrow_exception(look.fault);
  return std::move(look.recording);
}

}  // namespace stereobench::harness
