#include "harness/vision_scoring/frame_match.h"

#include <cmath>
#include <limits>
#include <utility>

#include "slam/math/elementary.h"
#include "vision/camera/rig.h"

namespace stereobench::harness {
namespace {

/// Whether an observation claims no other colour than the ball has.
bool suits_colour(const worlds::World& world, const BallInPair& ball,
                  const vision::BallObservation& observation) {
  return observation.colour == slam::kUnknown ||
         observation.colour == world.balls[static_cast<std::size_t>(ball.ball)].colour;
}

/// Whether an observation is within a ball's outline in both cameras. Where it says nothing of heights it is
/// taken to be at the ball's.
bool is_on(const vision::StereoRig& rig, const BallInPair& ball, const vision::BallObservation& observation) {
  if (observation.has_pixels)
    return contains(ball.left, observation.left_px) && contains(ball.right, observation.right_px);
  const slam::RangeBearing& seen = observation.range_bearing;
  const auto [s, c] = slam::sine_cosine(seen.bearing_rad);
  const Eigen::Vector3d in_robot(seen.range_m * c, seen.range_m * s, ball.ball_in_robot.z());
  const Eigen::Vector3d in_left = vision::robot_from_camera(rig).inverse() * in_robot;
  const Eigen::Vector3d in_right = vision::camera_point(rig, in_left, vision::Side::kRight);
  return in_left.z() > 0.0 && in_right.z() > 0.0 &&
         contains(ball.left, vision::project(rig.intrinsics, in_left)) &&
         contains(ball.right, vision::project(rig.intrinsics, in_right));
}

/// The ball under an observation: one whose colour suits it if there is one, else any that is not wholly
/// hidden; where no pixels tell balls of one direction apart, the one whose range is nearest.
std::optional<std::size_t> ball_under(const worlds::World& world, const vision::StereoRig& rig,
                                      const std::vector<BallInPair>& balls,
                                      const vision::BallObservation& observation) {
  std::optional<std::size_t> under;
  std::pair<bool, double> least;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const BallInPair& ball = balls[i];
    const bool hidden = ball.left_fraction <= 0.0 || ball.right_fraction <= 0.0;
    if (hidden || !is_on(rig, ball, observation)) continue;
    const double range_gap_m =
        std::abs(observation.range_bearing.range_m - ball.ball_in_robot.head<2>().norm());
    const std::pair<bool, double> misfit(!suits_colour(world, ball, observation),
                                         observation.has_pixels ? 0.0 : range_gap_m);
    if (under && misfit >= least) continue;
    under = i;
    least = misfit;
  }
  return under;
}

std::vector<vision::BallObservation> undistorted_observations(
    const vision::StereoRig& rig, std::span<const vision::BallObservation> observations) {
  const Eigen::Vector2d nowhere = Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  std::vector<vision::BallObservation> undistorted(observations.begin(), observations.end());
  for (vision::BallObservation& observation : undistorted) {
    observation.left_px = vision::pinhole_point(rig, observation.left_px).value_or(nowhere);
    observation.right_px = vision::pinhole_point(rig, observation.right_px).value_or(nowhere);
  }
  return undistorted;
}

}  // namespace

FrameMatch match_observations(const worlds::World& world, const vision::StereoRig& rig,
                              std::vector<BallInPair> outlines,
                              std::span<const vision::BallObservation> observations) {
  FrameMatch match{std::move(outlines), {}};
  for (const vision::BallObservation& observation : undistorted_observations(rig, observations)) {
    const auto under = ball_under(world, rig, match.outlines, observation);
    match.observations.push_back(
        {observation, under, under && suits_colour(world, match.outlines[*under], observation)});
  }
  return match;
}

FrameMatch match_observations(const VisionTruth& truth,
                              std::span<const vision::BallObservation> observations) {
  return match_observations(truth.world, truth.rig, ball_outlines(truth), observations);
}

std::vector<int> balls_observed(const FrameMatch& match) {
  std::vector<int> balls;
  for (const MatchedObservation& seen : match.observations)
    balls.push_back(seen.outline ? match.outlines[*seen.outline].ball : slam::kUnknown);
  return balls;
}

}  // namespace stereobench::harness
