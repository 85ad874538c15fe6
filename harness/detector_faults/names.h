/// Detections that bear a wrong name: the colour of another ball, or its number where balls are known by
/// that.
#pragma once

#include <cstdint>
#include <vector>

#include "harness/detector_faults/detection.h"
#include "harness/experiment/detector_faults.h"

namespace stereobench::harness {

/// Gives detections of a frame wrong names: first pairs swap theirs, then colours are confused. Each
/// detection is in one pair at most, whatever the probability; one is left over where their number is odd.
/// @param detections all that the detector gave; those without a name, or not to be trusted, keep what they
/// have
/// @return for each, whether its name has changed
std::vector<bool> give_wrong_names(const DetectorFaults& faults, std::uint64_t seed, std::size_t frame,
                                   std::vector<TracedDetection>& detections);

}  // namespace stereobench::harness
