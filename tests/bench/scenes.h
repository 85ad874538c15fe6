/// What is rendered where speed is measured.
#pragma once

#include <string>

#include "tests/worlds/scenario/read_scenario.h"

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

/// As many balls as stand beside each other three metres ahead: ten rows of ten.
inline Scene hundred_balls() {
  Scene scene = eighteen_balls();
  const double radius_m = scene.world.ball_radius_m();
  scene.world.balls.clear();
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d place(scene.pose.x_m + 3.0, scene.pose.y_m + 0.27 * (i % 10 - 4.5),
                                0.08 + 0.14 * (i / 10));
    scene.world.balls.push_back({.centre_m = place, .radius_m = radius_m, .colour = i % 18});
  }
  return scene;
}

/// The same walls with nothing before them.
inline Scene no_balls() {
  Scene scene = eighteen_balls();
  scene.world.balls.clear();
  return scene;
}

}  // namespace stereobench
