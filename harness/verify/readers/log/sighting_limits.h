/// What sightings may be off before they are faults: what the studies measure (docs/results.md).
#pragma once

namespace stereobench::harness {

/// A cause is named where it leaves this share of the disagreement, or less.
inline constexpr double kMostLeftBehindCause = 1.0 / 3.0;

/// A sighting may be off so many times what sightings are usually off,
inline constexpr double kMostOfUsualSighting = 10.0;
/// and always so much, m, and this share of its range: late pictures, and cameras that are not as they were
/// calibrated.
inline constexpr double kNoise_m = 0.05;
inline constexpr double kNoiseShare = 0.05;

}  // namespace stereobench::harness
