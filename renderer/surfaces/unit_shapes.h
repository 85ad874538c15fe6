/// Meshes that need no file.
#pragma once

#include <vector>

#include "renderer/meshes/mesh_file.h"

namespace stereobench::renderer {

/// The triangles of a shape of unit size, white, on the plane z = 0 around the origin, counter-clockwise from
/// outside. A ball has 320 faces, lit as if it were round.
/// @throws std::invalid_argument for kFile, which has none
std::vector<Triangle> unit_shape(worlds::MeshShape shape);

}  // namespace stereobench::renderer
