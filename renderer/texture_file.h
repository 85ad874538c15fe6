/// The pictures that a mesh file's materials name or hold.
#pragma once

#include <filesystem>
#include <optional>

#include <assimp/scene.h>

#include "renderer/texture.h"
#include "worlds/types.h"

namespace stereobench::renderer {

/// The picture of a material's diffuse (or base) colour: beside the mesh file, or within it. Transparency is
/// passed over, and what the file would mirror is repeated.
/// @param folder of the mesh file
/// @return none where the material has one colour
/// @throws std::runtime_error when it does not exist, is no picture, or is larger than a limit
std::optional<Texture> read_texture(const aiScene& scene, const aiMaterial& material,
                                    const std::filesystem::path& folder, const worlds::MeshLimits& limits);

}  // namespace stereobench::renderer
