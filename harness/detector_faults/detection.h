/// What a detector found, with what is known of it from the truth.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "harness/vision_scoring/frame_match.h"
#include "vision/types.h"
#include "worlds/oracle.h"

namespace stereobench::harness {

/// A detection, and what it is of.
struct TracedDetection {
  vision::BallObservation seen;            ///< of the oracle: range and bearing alone
  int ball = slam::kUnknown;               ///< index into World::balls; kUnknown: of none
  std::optional<double> visible_fraction;  ///< of that ball, in the camera that sees less of it
  std::uint64_t key = 0;                   ///< see detection_key
};

/// Observations of a pair as they were matched.
std::vector<TracedDetection> traced(std::span<const vision::BallObservation> observations,
                                    const FrameMatch& match);

/// What the oracle sensed.
std::vector<TracedDetection> traced(const worlds::Sightings& sensed);

/// The observations alone.
std::vector<vision::BallObservation> observations_of(std::span<const TracedDetection> detections);

/// The balls alone.
std::vector<int> balls_of(std::span<const TracedDetection> detections);

/// The oracle's sightings again.
worlds::Sightings oracle_sightings(std::span<const TracedDetection> detections);

}  // namespace stereobench::harness
