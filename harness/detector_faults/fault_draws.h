/// Numbers that faults of detectors are drawn with. Each is keyed by seed, fault, frame and ball: how large
/// one fault is moves no draw of another, and levels of one fault are nested.
#pragma once

#include <cstddef>
#include <cstdint>

#include "slam/math/random.h"

namespace stereobench::harness {

/// What a number is drawn for.
enum class FaultDraw : std::uint8_t {
  kCentre,
  kTail,
  kMiss,
  kBurst,
  kPairing,
  kSwap,
  kConfusion,
  kFalseCount,
  kFalse,
};

/// The number of a detection in its frame: of its ball, and of how many of that ball stand before it.
/// @param ball index into World::balls, or kUnknown
std::uint64_t detection_key(int ball, int repeat);

/// The numbers of one fault of one detection.
/// @param frame or a block of frames, below 2^32
/// @param detection below 2^24
slam::RandomStream fault_draws(std::uint64_t seed, FaultDraw fault, std::uint64_t frame,
                               std::uint64_t detection);

}  // namespace stereobench::harness
