/// Maps a measurement to its true landmark.
#pragma once

#include <optional>
#include <span>

#include "harness/types.h"

namespace stereobench::harness {

/// The landmark that the log says a sighting is of. Where it does not say, the one that the sighting names
/// or, where that names a colour only, the one of its colour nearest to where it was seen from the true pose.
/// @param sighting index into the step's measurements; without a true pose a colour alone is nobody's
/// @return an index; nothing when there is no such landmark
std::optional<std::size_t> measured_landmark(const LogStep& step, std::size_t sighting,
                                             std::span<const LandmarkTruth> landmarks);

}  // namespace stereobench::harness
