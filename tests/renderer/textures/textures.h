/// What tests of pictures on meshes, walls and floors share.
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>

#include "renderer/renderer.h"
#include "tests/renderer/random_scene.h"

namespace stereobench::renderer::test {

/// The linear light that a level of a picture file stands for (IEC 61966-2-1).
inline double light_of(int level) {
  const double x = level / 255.0;
  return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

/// What a renderer has against a world's files.
inline std::string complaint(const worlds::World& world) {
  try {
    Renderer(world, small_rig());
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no complaint";
}

}  // namespace stereobench::renderer::test
