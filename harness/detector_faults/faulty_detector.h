/// The faults of a detector, put into what it found: after it, and before anybody uses its answer.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "harness/detector/ball_geometry.h"
#include "harness/detector_faults/centre_noise.h"
#include "harness/detector_faults/detection.h"
#include "harness/detector_faults/fault_counts.h"
#include "harness/experiment/detector_faults.h"
#include "worlds/types.h"

namespace stereobench::harness {

/// Makes detections worse, frame by frame; lives as long as a drive. What it does to a detection depends on
/// seed, frame and ball alone, and on no other frame. Without faults it changes nothing, to the last bit.
class FaultyDetector {
 public:
  /// @param scenario as it is read: its rig as it is believed to be, its frames, its sensor
  /// @param world of the seed
  FaultyDetector(const DetectorFaults& faults, const worlds::Scenario& scenario, const worlds::World& world,
                 std::uint64_t seed);

  /// @param frame later than the one before
  /// @param detections of the frame, as the detector gave them
  /// @return what arrives at this frame: first what the detector found, in its order, then what is of nothing
  std::vector<TracedDetection> arriving(std::size_t frame, std::vector<TracedDetection> detections) {
    return delay(frame, worsen(frame, std::move(detections)));
  }

  /// The first part of arriving: all faults but latency.
  std::vector<TracedDetection> worsen(std::size_t frame, std::vector<TracedDetection> detections);

  /// The second part: what arrives at this frame.
  std::vector<TracedDetection> delay(std::size_t frame, std::vector<TracedDetection> detections);

  /// How many frames after the look its detections arrive.
  std::size_t latency_frames() const { return static_cast<std::size_t>(faults_.latency_frames); }

  /// So far; what has not arrived is counted as undelivered.
  FaultCounts counts() const;

 private:
  bool is_still_seen(std::size_t frame, TracedDetection& detection);
  bool move(std::size_t frame, TracedDetection& detection);
  void add_false(std::size_t frame, std::vector<TracedDetection>& detections);

  DetectorFaults faults_;
  std::uint64_t seed_;
  worlds::Identity identity_;
  worlds::OracleSensor oracle_;
  std::optional<BallGeometry> geometry_;  ///< none: the sensor is the oracle
  std::vector<int> colours_;              ///< of the balls
  CentreNoise noise_;
  std::map<std::size_t, std::vector<TracedDetection>> on_their_way_;  ///< by frame of the look
  FaultCounts counts_;
};

}  // namespace stereobench::harness
