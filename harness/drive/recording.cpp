#include "harness/drive/recording.h"

#include <algorithm>

#include <fmt/format.h>

#include "harness/detector/detector_process.h"
#include "harness/detector/detector_registry.h"
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

using Sense = std::function<Sightings(std::size_t index, const slam::Pose& pose)>;

Sense oracle_sense(const worlds::Scenario& scenario, const worlds::World& world, std::uint64_t seed) {
  return [&scenario, &world, seed](std::size_t index, const slam::Pose& pose) {
    slam::RandomStream noise(seed, slam::Stream::kOracle, index);
    slam::RandomStream chance(seed, slam::Stream::kClutter, index);
    const Sightings all = worlds::sense(world, pose, scenario.oracle, scenario.identity, noise);
    return worlds::with_faults(all, world, scenario.oracle, scenario.identity, chance);
  };
}

/// Renders and exposes each step's pair, shows it to the detector, and scores what that finds; lives as long
/// as the drive.
class StereoSense {
 public:
  StereoSense(const worlds::Scenario& scenario, const worlds::World& world, std::uint64_t seed,
              renderer::Backend backend, Detector detector, const renderer::FormReader& read)
      : scenario_(scenario),
        world_(world),
        seed_(seed),
        renderer_(world, scenario.rig, backend, renderer::light_for(scenario.camera), read),
        detector_(std::move(detector)) {}

  Sightings sense(std::size_t index, const slam::Pose& pose,
                  const std::function<void(const FrameEvent&)>& on_frame) {
    Stopwatch watch(timing_);
    const worlds::Shutter& shutter = scenario_.shutter;
    const std::optional<double> late_s = lateness_s(shutter, seed_, index);
    if (!late_s) return {};
    const ExposedFrame exposed = watch.time(
        "render", [&] { return open_shutter(renderer_, scenario_.path, index, shutter, *late_s); });
    blur_.add(exposed.blur_step_px);
    const vision::StereoPair pair =
        watch.time("expose", [&] { return renderer::expose(exposed.frame, scenario_.camera, seed_, index); });
    const std::int64_t stamp_ns = scenario_.path[index].stamp_ns;
    const auto observations = watch.time("observe", [&] {
      return detector_({index, stamp_ns, pair, scenario_.believed_rig});
    });
    const FrameMatch match = match_observations({world_, scenario_.rig, pose, exposed.frame}, observations);
    score_ += score_match(match);
    const worlds::World& meant = scenario_.world;
    score_.rig +=
        check_rig(scenario_.believed_rig, {meant.ball_radius_m(), meant.ball_radius_sd_m}, observations);
    on_frame({index, stamp_ns, pose, exposed.frame, pair, observations, match, world_, scenario_.rig, *late_s,
              &renderer_});
    return sightings_of(observations, balls_observed(match), world_.balls, scenario_.identity);
  }

  const VisionScore& score() const { return score_; }
  const CoarseBlur& blur() const { return blur_; }
  const Timing& timing() const { return timing_; }

 private:
  const worlds::Scenario& scenario_;
  const worlds::World& world_;
  std::uint64_t seed_;
  renderer::Renderer renderer_;
  Detector detector_;
  VisionScore score_;
  CoarseBlur blur_;
  Timing timing_;
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

void drive(const worlds::Scenario& scenario, std::uint64_t seed, const Sense& sense, MeasurementLog& log,
           const std::function<void(double)>& report) {
  slam::RandomStream odometry_stream(seed, slam::Stream::kOdometry);
  for (std::size_t index = 0; index < scenario.path.size(); ++index) {
    const worlds::PathStep& step = scenario.path[index];
    Sightings seen = sense(index, step.pose);
    log.steps.push_back(
        {.stamp_ns = step.stamp_ns,
         .odometry = measured_odometry(step.controls, scenario.odometry_noise, odometry_stream),
         .measurements = std::move(seen.measurements),
         .truth = step.pose,
         .true_landmarks = std::move(seen.balls)});
    report(static_cast<double>(index + 1) / static_cast<double>(scenario.path.size()));
  }
}

}  // namespace

Recording record(const Experiment& experiment, std::uint64_t seed, const Listeners& listeners,
                 renderer::Backend backend, const Detector& detector, const renderer::FormReader& read) {
  const worlds::Scenario& scenario = experiment.scenario;
  Recording recording;
  const worlds::World world = worlds::world_for_seed(scenario, seed);
  recording.log.landmarks = landmarks_of(world);
  if (!scenario.path.empty()) recording.log.start = scenario.path.front().pose;
  if (scenario.sensor == worlds::SensorKind::kOracle) {
    drive(scenario, seed, oracle_sense(scenario, world, seed), recording.log, listeners.on_progress);
    return recording;
  }
  const DetectorSetup setup = detector_setup(scenario);
  const std::string& command = experiment.detector.command;
  const DetectorKind* const linked = find_detector(command.empty() ? kOurs : command);
  std::optional<DetectorProcess> program;
  if (!detector && !linked) program.emplace(experiment.detector, setup, fmt::format("seed {}", seed));
  StereoSense stereo(scenario, world, seed, backend,
                     program    ? Detector(std::ref(*program))
                     : detector ? detector
                                : linked->make(setup),
                     read);
  const auto sense = [&](std::size_t index, const slam::Pose& pose) {
    return listeners.is_wanted(index) ? stereo.sense(index, pose, listeners.on_frame) : Sightings();
  };
  drive(scenario, seed, sense, recording.log, listeners.on_progress);
  if (program) program->finish();
  recording.detector = detector ? kCallable : command.empty() ? kOurs : command;
  recording.vision = stereo.score();
  recording.blur = stereo.blur();
  recording.timing = stereo.timing();
  return recording;
}

}  // namespace stereobench::harness
