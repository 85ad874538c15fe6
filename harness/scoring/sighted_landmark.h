/// Whose sighting a sighting is.
#pragma once

#include <optional>
#include <span>

#include "harness/types.h"

namespace stereobench::harness {

/// The landmark that a sighting names or, where it names a colour only, the one of its colour nearest to
/// where it was seen from the true pose.
/// @param truth world_from_robot; where it is not known, a colour alone is nobody's
/// @return an index; nothing when there is no such landmark
std::optional<std::size_t> sighted_landmark(const slam::RangeBearing& sighting,
                                            const std::optional<slam::Pose>& truth,
                                            std::span<const LandmarkTruth> landmarks);

}  // namespace stereobench::harness
