/// What formats need that hold rectified pairs of one instant.
#pragma once

#include <string>

#include "worlds/types.h"

namespace stereobench::harness {

/// The 3 x 4 projection matrix [K | t] of a rectified camera, row by row.
/// @param from_left_m how far right of the left camera it is, m
std::string projection_row(const vision::StereoRig& rig, double from_left_m);

/// The key of a scenario that such a format has no place for: a rig that is not rectified or that vision is
/// told wrong, or cameras that look at different times. @return empty where there is none
std::string key_without_place(const worlds::Scenario& scenario);

}  // namespace stereobench::harness
