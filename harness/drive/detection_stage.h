/// The stage between a detector and the filters: its answers, made worse where the experiment says so, are
/// held against the truth, and become sightings.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "harness/detector_faults/faulty_detector.h"
#include "harness/drive/sightings.h"
#include "harness/experiment/types.h"
#include "harness/vision_scoring/frame_match.h"
#include "harness/vision_scoring/vision_score.h"

namespace stereobench::harness {

/// What arrives of detections at a frame.
struct ArrivedDetections {
  std::vector<vision::BallObservation> observations;
  FrameMatch match;        ///< of the observations with what is seen at this frame
  std::vector<int> balls;  ///< that they are of, wherever they lie: index into World::balls, or kUnknown
};

/// Lives as long as a drive. What it makes of a frame does not depend on any picture.
class DetectionStage {
 public:
  /// @param experiment must live as long, and so must `world`, the world of the seed
  /// @param seed of the detector's faults
  DetectionStage(const Experiment& experiment, const worlds::World& world, std::uint64_t seed);

  /// Puts the detector's faults into its answer.
  /// @param frame later than the one before
  /// @param outlines of the balls in the pair that the detector was shown
  ArrivedDetections arriving(std::size_t frame, std::vector<BallInPair> outlines,
                             std::vector<vision::BallObservation> observations);

  /// Scores what has arrived. @return what filters are given of it
  Sightings take(const ArrivedDetections& arrived);

  /// How many frames after the look its detections arrive.
  std::size_t latency_frames() const { return faults_ ? faults_->latency_frames() : 0; }

  /// Of all that was taken.
  const VisionScore& score() const { return score_; }

  /// So far; empty where the experiment names no faults.
  std::optional<FaultCounts> fault_counts() const;

 private:
  FrameMatch match(std::vector<BallInPair> outlines,
                   std::span<const vision::BallObservation> observations) const;

  const worlds::Scenario& scenario_;
  const worlds::World& world_;
  PerfectDetections perfect_;
  std::optional<FaultyDetector> faults_;
  VisionScore score_;
};

}  // namespace stereobench::harness
