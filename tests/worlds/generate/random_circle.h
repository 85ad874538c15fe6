/// ball_circle left to chance: worlds for the tests of what is drawn.
#pragma once

#include <string>

#include "tests/worlds/scenario/read_scenario.h"
#include "tests/worlds/visibility/obj_solids.h"

namespace stereobench::worlds {

inline const std::string kCircle = std::string(STEREOBENCH_SOURCE_DIR) + "/assets/scenarios/ball_circle.yaml";
inline const std::string kAll =
    "randomise={ball_colours: {}, walls: {}, floor: {}, light: {}, clutter: {}, distractors: {}}";

/// One lap of ball_circle with a `randomise` entry.
inline Scenario scenario_with(const std::string& randomise) {
  return read_scenario(kCircle, {randomise, "path.laps=1"}, obj_solid);
}

/// One lap with every group of things left to chance.
inline const Scenario& everything() {
  static const Scenario scenario = scenario_with(kAll);
  return scenario;
}

}  // namespace stereobench::worlds
