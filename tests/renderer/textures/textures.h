/// What tests of pictures on meshes, walls and floors share.
#pragma once

#include <cmath>
#include <string>

#include "renderer/renderer.h"
#include "tests/complaint.h"
#include "tests/renderer/random_scene.h"

namespace stereobench::renderer::test {

/// The linear light that a level of a picture file stands for (IEC 61966-2-1).
inline double light_of(int level) {
  const double x = level / 255.0;
  return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

/// What a renderer has against a world's files.
inline std::string complaint(const worlds::World& world) {
  return complaint_of([&] { Renderer(world, small_rig()); });
}

}  // namespace stereobench::renderer::test
