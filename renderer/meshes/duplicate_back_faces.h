/// Surfaces that a mesh file describes twice, once for each side.
#pragma once

#include <vector>

#include "renderer/meshes/mesh_file.h"

namespace stereobench::renderer {

/// For each triangle whether another has the same corners and faces the other way, as modellers of thin walls
/// write them. Neither is nearer to a camera than the other: only the one that faces it may be drawn.
std::vector<bool> have_opposites(const std::vector<Triangle>& triangles);

}  // namespace stereobench::renderer
