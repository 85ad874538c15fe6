#include "renderer/texture_file.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include <fmt/core.h>
#include <opencv2/imgproc.hpp>

#include "renderer/picture_reader.h"

namespace stereobench::renderer {
namespace {

using Bytes = std::vector<std::uint8_t>;

[[noreturn]] void refuse(const std::string& name, const std::string& why) {
  throw std::runtime_error(fmt::format("its texture {} {}", name, why));
}

/// A file's name as people write it: from this folder, with either slash.
std::filesystem::path located(std::string name, const std::filesystem::path& folder) {
  std::replace(name.begin(), name.end(), '\\', '/');
  return folder / name;  // an absolute name stays
}

Bytes read_bytes(const std::string& name, const std::filesystem::path& folder,
                 const worlds::MeshLimits& limits) {
  const std::filesystem::path file = located(name, folder);
  if (!std::filesystem::is_regular_file(file)) refuse(name, "does not exist");
  if (std::filesystem::file_size(file) > static_cast<std::uintmax_t>(limits.file_mib) << 20U)
    refuse(name, fmt::format("is larger than {} MiB", limits.file_mib));
  return picture_bytes(file);
}

cv::Mat decoded(const std::string& name, PictureBytes bytes) {
  try {
    return decode_picture(bytes);
  } catch (const std::runtime_error& error) {
    refuse(name, error.what());
  }
}

/// A picture within the file: as the bytes of a picture file, or texel by texel.
cv::Mat embedded(const std::string& name, const aiTexture& texture) {
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(texture.pcData);
  if (texture.mHeight == 0) return decoded(name, {bytes, texture.mWidth});
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

Texture textured(cv::Mat picture) {
  cv::cvtColor(picture, picture, picture.channels() == 1 ? cv::COLOR_GRAY2RGB : cv::COLOR_BGR2RGB);
  return {picture.cols, picture.rows, {true, true}, Bytes(picture.datastart, picture.dataend)};
}

}  // namespace

std::optional<Texture> read_texture(const aiScene& scene, const aiMaterial& material,
                                    const std::filesystem::path& folder, const worlds::MeshLimits& limits) {
  for (const aiTextureType type : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}) {
    aiString path;
    if (material.GetTexture(type, 0, &path) != aiReturn_SUCCESS) continue;
    const std::string name = path.C_Str();
    const aiTexture* inside = scene.GetEmbeddedTexture(name.c_str());
    const cv::Mat picture =
        inside != nullptr ? embedded(name, *inside) : decoded(name, read_bytes(name, folder, limits));
    if (std::max(picture.cols, picture.rows) > limits.texture_px)
      refuse(name,
             fmt::format("is {} x {}, more than {} pixels", picture.cols, picture.rows, limits.texture_px));
    Texture texture = textured(picture);
    texture.repeats = {repeats(material, type, _AI_MATKEY_MAPPINGMODE_U_BASE),
                       repeats(material, type, _AI_MATKEY_MAPPINGMODE_V_BASE)};
    return texture;
  }
  return std::nullopt;
}

}  // namespace stereobench::renderer
