/// Promises about a scenario's balls that no value alone can break.
#pragma once

#include "worlds/types.h"
#include "worlds/yaml/yaml_value.h"

namespace stereobench::worlds {

/// Refuses balls that touch, balls of several sizes before a stereo camera that measures by size, colours
/// that do not tell known identities apart, and balls that look alike nearer than colour_spacing_m. Each
/// holds for every seed: placement jitter is counted in.
///
/// @param list the `world.balls` list, for the place in the file
/// @throws std::runtime_error naming the ball
void check_balls(const Scenario& scenario, const YamlValue& list);

}  // namespace stereobench::worlds
