#include "renderer/surfaces/surface_textures.h"

#include <map>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "renderer/textures/texture_file.h"

namespace stereobench::renderer {
namespace {

/// The textures of a world, while those of its surfaces are added.
class Album {
 public:
  Album(const worlds::MeshLimits& limits, std::vector<Texture>& textures)
      : limits_(limits), textures_(textures) {}

  PolygonTexture place(const worlds::SurfaceTexture& asked) {
    const auto [place, is_new] = indices_.try_emplace(asked.file, static_cast<int>(textures_.size()));
    if (is_new) read(asked);
    const Texture& texture = textures_[static_cast<std::size_t>(place->second)];
    return {place->second, static_cast<float>(texture.width_px / asked.tile_m),
            static_cast<float>(texture.height_px)};
  }

 private:
  void read(const worlds::SurfaceTexture& asked) {
    try {
      textures_.push_back(read_texture(asked.file, limits_));
    } catch (const std::runtime_error& error) {
      refuse(asked, error.what());
    }
    if (exceed(textures_, limits_))
      refuse(asked, fmt::format("makes the world's textures more than {} MiB", limits_.texture_mib));
  }

  [[noreturn]] static void refuse(const worlds::SurfaceTexture& asked, const std::string& why) {
    const std::string place = asked.stated_at.empty() ? "" : asked.stated_at + ": ";
    throw std::runtime_error(fmt::format("{}{} {}", place, asked.file, why));
  }

  const worlds::MeshLimits& limits_;
  std::vector<Texture>& textures_;
  std::map<std::string, int> indices_;
};

}  // namespace

Surfaces place_surfaces(const worlds::World& world, const FormReader& read) {
  Surfaces surfaces{place_meshes(world, read), {}};
  Album album(world.mesh_limits, surfaces.meshes.textures);
  const auto add = [&](worlds::Material material, const worlds::SurfaceTexture& texture) {
    surfaces.polygons.push_back(material == worlds::Material::kFile ? album.place(texture)
                                                                    : PolygonTexture{});
  };
  add(world.floor, world.floor_texture);
  for (const worlds::Wall& wall : world.walls) add(wall.material, wall.texture);
  return surfaces;
}

}  // namespace stereobench::renderer
