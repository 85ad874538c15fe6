#include "worlds/scenario/scenario_parts.h"

namespace stereobench::worlds {
namespace {

void read_picture(const YamlValue& file, SurfaceTexture& texture) {
  if (!std::filesystem::is_regular_file(file.path())) file.fail("expected a picture that exists");
  texture.file = file.path().string();
  texture.stated_at = file.place();
}

}  // namespace

const Fields<SurfaceTexture>& surface_texture_keys() {
  static const Fields<SurfaceTexture> keys({
      text("file", "Picture, relative to the scenario's folder; sRGB.")
          .needed()
          .by<SurfaceTexture>(read_picture,
                              [](const SurfaceTexture& texture) { return YAML::Node(texture.file); }),
      number("tile_m", {1e-3, 1e3}, "Width of the picture on the surface, in metres; its texels are square.")
          .fills(&SurfaceTexture::tile_m),
  });
  return keys;
}

}  // namespace stereobench::worlds
