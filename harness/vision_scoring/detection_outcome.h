/// What became of the balls and the detections of a stereo pair.
#pragma once

#include <vector>

#include "harness/vision_scoring/frame_match.h"

namespace stereobench::harness {

enum class DetectionOutcome {
  kTruePositive,   ///< the first of its ball, with the ball's colour or none
  kWrongIdentity,  ///< on a ball of another colour
  kDuplicate,      ///< on a ball that has a true positive
  kFalsePositive,  ///< on no ball
  kFlagged,        ///< not to be trusted, by its own word
};

/// "true_positive" and so on, as files have it.
const char* text_of(DetectionOutcome outcome);

/// What files call a ball that had to be found and was not.
inline constexpr const char* kMiss = "miss";

/// The outcomes of one pair.
struct PairOutcome {
  std::vector<DetectionOutcome> detections;  ///< one an observation
  std::vector<bool> is_required;             ///< one an outline: whether its ball must be found
  std::vector<bool> is_found;                ///< one an outline: whether it has a true positive
};

/// Judges the observations of one pair. A ball must be found when its outline lies within both images, has a
/// radius of at least 5 px, and at least 95 % of it is seen by each camera. Of several trusted observations
/// of one ball the first counts as right.
PairOutcome judge_detections(const FrameMatch& match);

}  // namespace stereobench::harness
