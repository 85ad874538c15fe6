/// Meshes on their way through a pipe.
#pragma once

#include <string>

#include "renderer/meshes/mesh_file.h"

namespace stereobench::renderer {

/// A mesh as bytes, exact.
std::string packed(const Mesh& mesh);

/// What packed made bytes of.
/// @throws std::runtime_error when they are not all there
Mesh unpacked(const std::string& bytes);

}  // namespace stereobench::renderer
