// What a scenario file may hold, and the world of a seed.
#include <cstdio>

#include "worlds/scenario/scenario.h"

using namespace stereobench;

int main() {
  const worlds::Key* const key = worlds::declared_key(worlds::scenario_keys(), "rig.baseline_m");
  const worlds::Scenario scenario;
  const worlds::World world = worlds::world_for_seed(scenario, 1);
  std::printf("%s\n", key ? key->says.c_str() : "no such key");
  return key && world.balls.size() == scenario.world.balls.size() ? 0 : 1;
}
