/// Textures from files: pictures, and those that a mesh file's materials name or hold.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include <assimp/scene.h>

#include "renderer/textures/texture.h"
#include "renderer/textures/texture_search.h"
#include "worlds/types.h"

namespace stereobench::renderer {

/// A picture as a texture that is repeated.
/// @throws std::runtime_error that says of the file, in one line, "does not exist", "is 5000 x 2, more than
/// ..."
Texture read_texture(const std::filesystem::path& file, const worlds::MeshLimits& limits);

/// A material's picture.
struct MaterialTexture {
  Texture texture;
  aiTextureType type = aiTextureType_NONE;               ///< where the material keeps what it says of it
  std::optional<MissingTexture> missing = std::nullopt;  ///< then the texture is grey
};

/// The picture of a material's diffuse (or base) colour: beside the mesh file, or within it. Transparency is
/// passed over, and what the file would mirror is repeated.
/// @return none where the material has one colour
/// @throws std::runtime_error when it is no picture, or is larger than a limit
std::optional<MaterialTexture> read_texture(const aiScene& scene, const aiMaterial& material,
                                            const TextureFolders& folders, const worlds::MeshLimits& limits);

/// Whether these are more than a world may have.
bool exceed(const std::vector<Texture>& textures, const worlds::MeshLimits& limits);

}  // namespace stereobench::renderer
