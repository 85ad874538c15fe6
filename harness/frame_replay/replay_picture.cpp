#include "harness/frame_replay/replay_picture.h"

#include <fmt/format.h>

#include "harness/report/detection_picture.h"
#include "harness/vision_scoring/detection_outcome.h"

namespace stereobench::harness {
namespace {

constexpr int kDrawnWidth_px = 2048;

/// The balls of a pair; those of which no pixel is seen are not drawn.
DrawnTruth drawn_truth(const ReplayedFrame& frame) {
  DrawnTruth truth{.left_ids = frame.truth.left.ball_id, .right_ids = frame.truth.right.ball_id, .balls = {}};
  const PairOutcome outcome = judge_detections(frame.match);
  for (std::size_t i = 0; i < frame.match.outlines.size(); ++i) {
    const int ball = frame.match.outlines[i].ball;
    const bool is_missed = outcome.is_required[i] && !outcome.is_found[i];
    truth.balls.push_back({ball + 1, fmt::format("ball {}{}", ball, is_missed ? " missed" : ""), is_missed});
  }
  return truth;
}

}  // namespace

std::string draw_replay_picture(const ReplayedFrame& frame) {
  return draw_detection_picture(for_display(frame.pair, frame.camera), frame.observations, kDrawnWidth_px,
                                drawn_truth(frame));
}

}  // namespace stereobench::harness
