/// What is rendered where speed is measured.
#pragma once

#include <string>

#include "worlds/scenario.h"

namespace stereobench {

/// A world as it is rendered from one place.
struct Scene {
  worlds::World world;
  vision::StereoRig rig;
  slam::Pose pose;
};

/// A quarter of the way along a shipped scenario's path.
inline Scene scenario_scene(const std::string& name) {
  const auto scenario =
      worlds::read_scenario(std::string(STEREOBENCH_SOURCE_DIR) + "/assets/scenarios/" + name + ".yaml");
  return {scenario.world, scenario.rig, scenario.path[scenario.path.size() / 4].pose};
}

/// All eighteen colours in view, in three rows before the walls of ball_circle's room.
inline Scene eighteen_balls() {
  Scene scene = scenario_scene("ball_circle");
  scene.pose = {-2.5, 1.0, 0.0};
  scene.world.meshes.clear();
  for (std::size_t i = 0; i < scene.world.balls.size(); ++i) {
    const double row = static_cast<double>(i / 6);
    const double column = static_cast<double>(i % 6) - 2.5;
    const double ahead_m = 2.0 + 0.8 * row;
    scene.world.balls[i].centre_m = {scene.pose.x_m + ahead_m, scene.pose.y_m + 0.18 * ahead_m * column,
                                     0.1 + 0.2 * row};
  }
  return scene;
}

}  // namespace stereobench
