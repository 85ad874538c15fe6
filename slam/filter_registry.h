/// The filters by name: one row a filter.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "slam/filter.h"
#include "slam/filter_config.h"

namespace stereobench::slam {

/// What the program knows of a filter.
struct FilterKind {
  std::string_view name;   ///< on command lines and in files
  std::string_view title;  ///< as people write it, e.g. "FastSLAM 2.0"
  bool maps_landmarks;     ///< false: it is blind to sightings, as dead reckoning is
  bool is_usual;           ///< is run where nobody says which
  Filter (*start)(const FilterConfig& config, const Pose& start, std::uint64_t seed);
};

/// @return all filters, in the order in which they are listed
std::span<const FilterKind> filter_kinds();

/// @return the filter of a name; null when there is none
const FilterKind* find_filter_kind(std::string_view name);

/// @return the names that make_filter knows
std::vector<std::string> filter_names();

/// @return the names of those that are run where nobody says which
std::vector<std::string> usual_filter_names();

/// Starts a filter at a known pose with an empty map.
///
/// @param name one of filter_names()
/// @param config settings
/// @param start world_from_robot, without uncertainty: the start defines the world frame
/// @param seed key of the filter's random numbers
/// @throws std::invalid_argument for an unknown name, a setting out of range or a start that is not finite
Filter make_filter(const std::string& name, const FilterConfig& config, const Pose& start,
                   std::uint64_t seed);

}  // namespace stereobench::slam
