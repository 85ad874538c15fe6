/// Which ball each observation of a stereo pair is of: worked out once a frame, used by scores, logs and
/// pictures.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "harness/vision_scoring/ball_outline.h"
#include "vision/types.h"

namespace stereobench::harness {

/// An observation and the ball under it.
struct MatchedObservation {
  vision::BallObservation undistorted;  ///< its centres where a true rig without distortion would have them;
                                        ///< NaN where there is no such place
  std::optional<std::size_t> outline;   ///< index into FrameMatch::outlines; none: it is of no ball
  bool colour_agrees = false;           ///< it claims the ball's colour, or none
};

/// The balls of a pair and its observations.
struct FrameMatch {
  std::vector<BallInPair> outlines;              ///< of the balls ahead of both cameras
  std::vector<MatchedObservation> observations;  ///< in the order in which they were given
};

/// Matches the observations of one pair with the balls. An observation is of a ball when its centres lie
/// within the ball's outlines in both cameras; one without pixels is looked for at the height of each ball.
/// Of several balls one whose colour agrees goes first; without pixels, then the one whose range is nearest.
FrameMatch match_observations(const VisionTruth& truth,
                              std::span<const vision::BallObservation> observations);

/// The same where the balls' outlines are known already. @param outlines of ball_outlines
FrameMatch match_observations(const worlds::World& world, const vision::StereoRig& rig,
                              std::vector<BallInPair> outlines,
                              std::span<const vision::BallObservation> observations);

/// Whose each observation is, whatever colour it claims.
/// @return indices into World::balls; kUnknown where there is none
std::vector<int> balls_observed(const FrameMatch& match);

}  // namespace stereobench::harness
