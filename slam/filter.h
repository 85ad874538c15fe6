/// The filters, by name, behind one contract: predict with each control, update with each frame, ask.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <variant>

#include "slam/association/decisions.h"
#include "slam/block/block_slam.h"
#include "slam/dead_reckoning.h"
#include "slam/ekf/ekf_slam.h"
#include "slam/fastslam/fast_slam.h"
#include "slam/filter_config.h"
#include "slam/filter_names.h"
#include "slam/types.h"
#include "slam/update_report.h"

namespace stereobench::slam {

/// A filter is a value: a copy goes its own way and shares nothing with the original.
using Filter = std::variant<DeadReckoning, EkfSlam, LinearisedFastSlam, UnscentedFastSlam,
                            LinearisedBlockSlam, UnscentedBlockSlam>;

/// Starts a filter at a known pose with an empty map.
///
/// @param name one of filter_names()
/// @param config settings
/// @param start world_from_robot, without uncertainty: the start defines the world frame
/// @param seed key of the filter's random numbers
/// @throws std::invalid_argument for an unknown name, a setting out of range or a start that is not finite
Filter make_filter(const std::string& name, const FilterConfig& config, const Pose& start,
                   std::uint64_t seed);

/// Moves the belief by one control. One that is not finite or runs backwards in time is ignored and counted.
void predict(Filter& filter, const Control& control);

/// Corrects the belief by what was seen at one instant; an empty frame is none at all. A sighting that is not
/// finite, has a negative range or an impossible covariance is ignored and counted.
void update(Filter& filter, std::span<const RangeBearing> sightings);

/// @return what the filter believes now: pose, map and what it had to mend so far
Estimate estimate(const Filter& filter);

/// @return what the last update found out about the filter; empty unless its settings ask for reports
UpdateReport last_update(const Filter& filter);

/// @return how many particles a filter has; 1 for those that are one Gaussian
int particle_count(const Filter& filter);

/// @return the same without its map, at a cost that does not depend on the map
Estimate estimate_without_map(const Filter& filter);

/// @return what became of the sightings of the last update; for a filter of many particles, by the one that
/// the frame left heaviest. Nothing for a filter without a map
Decisions last_decisions(const Filter& filter);

}  // namespace stereobench::slam
