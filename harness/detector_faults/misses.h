/// Which detections are lost.
#pragma once

#include <cstdint>
#include <optional>

#include "harness/experiment/detector_faults.h"

namespace stereobench::harness {

/// The probability that a detection is lost, for any of the three reasons; they do not depend on each other.
/// @param range_m as it was detected
/// @param visible_fraction of its ball; none: it is of no ball, or nothing hides balls
double loss_probability(const DetectorFaults& faults, double range_m, std::optional<double> visible_fraction);

/// Whether a detection is lost. Bursts begin where a ball's own clock says, at every miss_burst_frames-th
/// frame: the share of what is lost does not depend on their length.
/// @param detection see detection_key
bool is_lost(const DetectorFaults& faults, std::uint64_t seed, std::size_t frame, std::uint64_t detection,
             double probability);

}  // namespace stereobench::harness
