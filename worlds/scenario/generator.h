/// Worlds that are made, by a scenario's line.
#pragma once

#include "worlds/generate/ball_placement.h"
#include "worlds/generate/layout.h"
#include "worlds/yaml/yaml_value.h"

namespace stereobench::worlds {

/// `world.generator`: what stands before the drive is known, and how balls are placed along it.
struct Generator {
  Layout layout;  ///< empty for balls without walls
  PlacementRules rules;
};

/// Reads a generator and makes its floor plan.
/// @param ball_radius_m of its balls
/// @throws std::runtime_error naming the generator when there is no such plan
Generator read_generator(const YamlValue& value, double ball_radius_m);

}  // namespace stereobench::worlds
