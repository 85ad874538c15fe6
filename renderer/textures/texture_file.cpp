#include "renderer/textures/texture_file.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/core.h>
#include <opencv2/imgproc.hpp>

#include "renderer/pictures/picture_formats.h"
#include "renderer/textures/mip_chain.h"

namespace stereobench::renderer {
namespace {

/// What is drawn in place of a texture that is nowhere: half of the light.
Texture grey() {
  constexpr std::uint8_t kHalfTheLight = 188;  // as sRGB
  return {1, 1, {true, true}, {kHalfTheLight, kHalfTheLight, kHalfTheLight}};
}

Texture as_texture(const cv::Mat& picture) {
  cv::Mat rgb;
  cv::cvtColor(picture, rgb, picture.channels() == 1 ? cv::COLOR_GRAY2RGB : cv::COLOR_BGR2RGB);
  return {rgb.cols, rgb.rows, {true, true}, {rgb.datastart, rgb.dataend}};
}

/// A picture within the file: as the bytes of a picture file, or texel by texel.
cv::Mat embedded(const aiTexture& texture, int longest_px) {
  if (texture.mHeight == 0)
    return decode_picture({reinterpret_cast<const std::uint8_t*>(texture.pcData), texture.mWidth},
                          longest_px);
  check_size(texture.mWidth, texture.mHeight, longest_px);
  cv::Mat picture(static_cast<int>(texture.mHeight), static_cast<int>(texture.mWidth), CV_8UC3);
  for (std::size_t i = 0; i < picture.total(); ++i) {
    const aiTexel& texel = texture.pcData[i];
    picture.at<cv::Vec3b>(static_cast<int>(i / texture.mWidth), static_cast<int>(i % texture.mWidth)) = {
        texel.b, texel.g, texel.r};
  }
  return picture;
}

bool repeats(const aiMaterial& material, aiTextureType type, const char* key) {
  int mode = aiTextureMapMode_Wrap;
  material.Get(key, static_cast<unsigned>(type), 0, mode);
  return mode != aiTextureMapMode_Clamp && mode != aiTextureMapMode_Decal;
}

}  // namespace

Texture read_texture(const std::filesystem::path& file, const worlds::MeshLimits& limits) {
  if (!std::filesystem::is_regular_file(file)) throw std::runtime_error("does not exist");
  if (std::filesystem::file_size(file) > static_cast<std::uintmax_t>(limits.file_mib) << 20U)
    throw std::runtime_error(fmt::format("is larger than {} MiB", limits.file_mib));
  return as_texture(decode_picture(picture_bytes(file), limits.texture_px));
}

std::optional<MaterialTexture> read_texture(const aiScene& scene, const aiMaterial& material,
                                            const TextureFolders& folders, const worlds::MeshLimits& limits) {
  for (const aiTextureType type : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}) {
    aiString path;
    if (material.GetTexture(type, 0, &path) != aiReturn_SUCCESS) continue;
    const std::string name = path.C_Str();
    const aiTexture* inside = scene.GetEmbeddedTexture(name.c_str());
    const TextureFolders::Found found = inside != nullptr ? TextureFolders::Found{} : folders.find(name);
    if (inside == nullptr && found.file.empty())
      return MaterialTexture{grey(), type, MissingTexture{name, found.leads_out}};
    try {
      Texture texture = inside != nullptr ? as_texture(embedded(*inside, limits.texture_px))
                                          : read_texture(found.file, limits);
      texture.repeats = {repeats(material, type, _AI_MATKEY_MAPPINGMODE_U_BASE),
                         repeats(material, type, _AI_MATKEY_MAPPINGMODE_V_BASE)};
      return MaterialTexture{std::move(texture), type};
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(fmt::format("its texture {} {}", name, error.what()));
    }
  }
  return std::nullopt;
}

bool exceed(const std::vector<Texture>& textures, const worlds::MeshLimits& limits) {
  std::size_t texels = 0;
  for (const Texture& texture : textures) texels += mip_size(texture);
  return texels > static_cast<std::size_t>(limits.texture_mib) << 18U;  // of four bytes each
}

}  // namespace stereobench::renderer
