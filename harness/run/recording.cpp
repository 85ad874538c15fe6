#include "harness/run/recording.h"

#include <algorithm>

#include "harness/run/shutter.h"
#include "harness/run/stopwatch.h"
#include "renderer/develop.h"
#include "renderer/expose.h"
#include "renderer/renderer.h"
#include "slam/motion.h"
#include "slam/random.h"
#include "vision/observe.h"
#include "worlds/oracle.h"
#include "worlds/scenario.h"

namespace stereobench::harness {
namespace {

constexpr double kTypicalLevel = 128.0;  ///< at which vision is told how large the camera's noise is

/// What a robot senses at a step of its path, and whose each measurement is.
struct Sensed {
  std::vector<slam::RangeBearing> measurements;
  std::vector<int> balls;
};
using Sense = std::function<Sensed(std::size_t index, const slam::Pose& pose)>;

/// The measurements a filter is given: whole balls only, and where colours are unique the ball's identity,
/// which the robot knows by its colour.
///
/// @param balls whose each observation is
Sensed measurements_of(const std::vector<vision::BallObservation>& observations,
                       const std::vector<int>& balls, const worlds::World& world, worlds::Identity identity) {
  Sensed sensed;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const vision::BallObservation& observation = observations[i];
    if (!observation.whole()) continue;
    slam::RangeBearing measurement = observation.range_bearing;
    if (identity == worlds::Identity::kNone) measurement.colour_class = slam::kUnknown;
    if (identity == worlds::Identity::kKnown) {
      const auto ball = std::find_if(world.balls.begin(), world.balls.end(),
                                     [&](const worlds::Ball& b) { return b.colour == observation.colour; });
      if (ball == world.balls.end()) continue;  // a colour that no landmark has
      measurement.landmark_id = static_cast<int>(ball - world.balls.begin());
    }
    sensed.measurements.push_back(measurement);
    sensed.balls.push_back(balls[i]);
  }
  return sensed;
}

Sense oracle_sense(const worlds::Scenario& scenario, const worlds::World& world, std::uint64_t seed) {
  return [&scenario, &world, seed](std::size_t index, const slam::Pose& pose) {
    slam::RandomStream noise(seed, slam::Stream::kOracle, index);
    slam::RandomStream chance(seed, slam::Stream::kClutter, index);
    const worlds::OracleLook all = worlds::sense(world, pose, scenario.oracle, scenario.identity, noise);
    worlds::OracleLook look = worlds::with_faults(all, world, scenario.oracle, scenario.identity, chance);
    return Sensed{std::move(look.sightings), std::move(look.balls)};
  };
}

/// Renders, exposes, observes and scores each step's pair; lives as long as the drive.
class StereoSense {
 public:
  StereoSense(const worlds::Scenario& scenario, const worlds::World& world, std::uint64_t seed,
              renderer::Backend backend)
      : scenario_(scenario),
        world_(world),
        seed_(seed),
        renderer_(world, scenario.rig, backend),
        rectification_(scenario.believed_rig) {
    settings_.ball_radius_m = world.balls.empty() ? settings_.ball_radius_m : world.balls.front().radius_m;
    settings_.noise_sd_levels = renderer::noise_sd_levels(scenario.camera, kTypicalLevel);
  }

  Sensed look(std::size_t index, const slam::Pose& pose, const std::function<void(const Look&)>& on_look) {
    Stopwatch watch(timing_);
    const worlds::Shutter& shutter = scenario_.shutter;
    slam::RandomStream chance(seed_, slam::Stream::kFrameLoss, index);
    if (chance.uniform() < shutter.drop_probability) return {};
    const double late_s = chance.uniform() < shutter.late_probability ? shutter.late_s : 0.0;
    const renderer::StereoFrame frame =
        watch.time("render", [&] { return open_shutter(renderer_, scenario_.path, index, shutter, late_s); });
    const vision::StereoPair pair =
        watch.time("expose", [&] { return renderer::expose(frame, scenario_.camera, seed_, index); });
    const auto observations = watch.time("observe", [&] {
      const vision::StereoPair light = {renderer::decode(pair.left, scenario_.camera),
                                        renderer::decode(pair.right, scenario_.camera)};
      return vision::observe(light, rectification_, settings_);
    });
    const VisionTruth truth = {world_, scenario_.rig, pose, frame};
    score_ += score_observations(truth, observations);
    on_look({index, frame, pair, observations});
    return measurements_of(observations, balls_observed(truth, observations), world_, scenario_.identity);
  }

  const VisionScore& score() const { return score_; }
  const Timing& timing() const { return timing_; }

 private:
  const worlds::Scenario& scenario_;
  const worlds::World& world_;
  std::uint64_t seed_;
  renderer::Renderer renderer_;
  vision::Rectification rectification_;
  vision::ObserverSettings settings_;
  VisionScore score_;
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
    Sensed sensed = sense(index, step.pose);
    log.steps.push_back(
        {.stamp_ns = step.stamp_ns,
         .odometry = measured_odometry(step.controls, scenario.odometry_noise, odometry_stream),
         .measurements = std::move(sensed.measurements),
         .truth = step.pose,
         .true_landmarks = std::move(sensed.balls)});
    report(static_cast<double>(index + 1) / static_cast<double>(scenario.path.size()));
  }
}

}  // namespace

Recording record(const worlds::Scenario& scenario, std::uint64_t seed, const Listeners& listeners,
                 renderer::Backend backend) {
  Recording recording;
  const worlds::World world = worlds::world_for_seed(scenario, seed);
  recording.log.landmarks = landmarks_of(world);
  if (!scenario.path.empty()) recording.log.start = scenario.path.front().pose;
  if (scenario.sensor == worlds::SensorKind::kOracle) {
    drive(scenario, seed, oracle_sense(scenario, world, seed), recording.log, listeners.on_progress);
    return recording;
  }
  StereoSense stereo(scenario, world, seed, backend);
  const auto look = [&](std::size_t index, const slam::Pose& pose) {
    return stereo.look(index, pose, listeners.on_look);
  };
  drive(scenario, seed, look, recording.log, listeners.on_progress);
  recording.vision = stereo.score();
  recording.timing = stereo.timing();
  return recording;
}

}  // namespace stereobench::harness
