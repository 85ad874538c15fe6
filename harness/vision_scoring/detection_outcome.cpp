#include "harness/vision_scoring/detection_outcome.h"

#include <algorithm>

namespace stereobench::harness {
namespace {

constexpr double kSmallestRadius_px = 5.0;

/// A ball has to be found when it is whole, not tiny and hardly hidden.
bool must_be_found(const BallInPair& ball) {
  return is_whole(ball) && std::min(ball.left.radius_px(), ball.right.radius_px()) >= kSmallestRadius_px;
}

DetectionOutcome outcome_of(const MatchedObservation& seen, const std::vector<bool>& is_found) {
  if (!seen.undistorted.trusted()) return DetectionOutcome::kFlagged;
  if (!seen.outline) return DetectionOutcome::kFalsePositive;
  if (!seen.colour_agrees) return DetectionOutcome::kWrongIdentity;
  return is_found[*seen.outline] ? DetectionOutcome::kDuplicate : DetectionOutcome::kTruePositive;
}

}  // namespace

const char* text_of(DetectionOutcome outcome) {
  switch (outcome) {
    case DetectionOutcome::kTruePositive:
      return "true_positive";
    case DetectionOutcome::kWrongIdentity:
      return "wrong_identity";
    case DetectionOutcome::kDuplicate:
      return "duplicate";
    case DetectionOutcome::kFalsePositive:
      return "false_positive";
    case DetectionOutcome::kFlagged:
      break;
  }
  return "flagged";
}

PairOutcome judge_detections(const FrameMatch& match) {
  PairOutcome pair{.is_found = std::vector<bool>(match.outlines.size(), false)};
  for (const MatchedObservation& seen : match.observations) {
    pair.detections.push_back(outcome_of(seen, pair.is_found));
    if (pair.detections.back() == DetectionOutcome::kTruePositive) pair.is_found[*seen.outline] = true;
  }
  for (const BallInPair& ball : match.outlines) pair.is_required.push_back(must_be_found(ball));
  return pair;
}

}  // namespace stereobench::harness
