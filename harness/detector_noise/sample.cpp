#include "harness/detector_noise/sample.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/detector/detector.h"
#include "harness/detector_noise/outline_bound.h"
#include "harness/drive/recording.h"
#include "harness/vision_scoring/frame_match.h"
#include "renderer/camera/sensor_model.h"
#include "slam/math/elementary.h"
#include "slam/models/motion.h"
#include "vision/camera/rig.h"
#include "vision/pixel_noise.h"
#include "worlds/scenario/scenario.h"

namespace stereobench::harness {
namespace {

/// The bounds on range and bearing that the picture's noise makes.
/// @param world the calibration scene's, as its seed has it
BallBounds bounds_of(const worlds::Scenario& scene, const worlds::World& world,
                     const renderer::StereoFrame& frame, const BallInPair& ball, double noise_sd_levels) {
  const vision::StereoRig& rig = scene.rig;
  const PictureQuality quality = {std::sqrt(vision::pixel_variance(noise_sd_levels)),
                                  scene.camera.defocus_sd_px};
  vision::SizedBall sized;
  sized << vision::robot_from_camera(rig).inverse() * ball.ball_in_robot,
      world.balls[static_cast<std::size_t>(ball.ball)].radius_m;
  return ball_bounds(
      rig, sized, world.ball_radius_sd_m,
      {outline_information(renderer::in_levels(frame.left.colour), rig.intrinsics, ball.left, quality),
       outline_information(renderer::in_levels(frame.right.colour), rig.intrinsics, ball.right, quality)});
}

CalibrationSample compare(const BallInPair& ball, const vision::BallObservation& observation) {
  CalibrationSample sample;
  const slam::RangeBearing& seen = observation.range_bearing;
  const Eigen::Vector2d place = ball.ball_in_robot.head<2>();
  sample.truth = {place.norm(), slam::arc_tangent(place.y(), place.x())};
  sample.error = {seen.range_m - sample.truth.x(), slam::wrap_angle(seen.bearing_rad - sample.truth.y())};
  sample.stated = seen.covariance;
  sample.disparity_error_px = disparity_error_px(ball, observation);
  sample.radius_error_px = {observation.left_radius_px - ball.left.radius_px(),
                            observation.right_radius_px - ball.right.radius_px()};
  if (!observation.has_radii) sample.radius_error_px.fill(std::numeric_limits<double>::quiet_NaN());
  sample.whole = is_whole(ball);
  return sample;
}

}  // namespace

CalibrationTake take_samples(const Experiment& experiment, std::uint64_t seed, renderer::Backend backend) {
  const worlds::Scenario& scene = experiment.scenario;
  CalibrationTake take;
  const double noise_sd_levels = detector_setup(scene).noise_sd_levels;
  Listeners listeners;
  const worlds::World world = worlds::world_for_seed(scene, seed);
  listeners.on_frame = [&](const FrameEvent& event) {
    for (const MatchedObservation& seen : event.match.observations) {
      if (!seen.undistorted.trusted() || !seen.colour_agrees) continue;
      const BallInPair& ball = event.match.outlines[*seen.outline];
      CalibrationSample sample = compare(ball, seen.undistorted);
      sample.depth_m = (vision::robot_from_camera(scene.rig).inverse() * ball.ball_in_robot).z();
      if (sample.whole) sample.bounds = bounds_of(scene, world, event.frame, ball, noise_sd_levels);
      take.samples.push_back(sample);
    }
  };
  take.score = *record(experiment, seed, listeners, backend).vision;
  return take;
}

}  // namespace stereobench::harness
