#include "harness/drive/drive_log.h"

#include <vector>

#include "slam/math/random.h"
#include "slam/models/motion.h"

namespace stereobench::harness {
namespace {

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

}  // namespace

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

}  // namespace stereobench::harness
