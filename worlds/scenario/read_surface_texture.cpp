#include "worlds/scenario/scenario_parts.h"

namespace stereobench::worlds {

const KeyGroup& surface_texture_keys() {
  static const KeyGroup keys = {
      .keys = {
          text("file", "Picture, relative to the scenario's folder; sRGB.").needed(),
          number("tile_m", {1e-3, 1e3},
                 "Width of the picture on the surface, in metres; its texels are square.")
              .otherwise("1"),
      }};
  return keys;
}

SurfaceTexture read_surface_texture(const YamlValue& value, const std::filesystem::path& folder) {
  const YamlMap map(value, surface_texture_keys());
  const YamlValue file = map.at("file");
  const std::filesystem::path path = std::filesystem::absolute(folder / file.text()).lexically_normal();
  if (!std::filesystem::is_regular_file(path)) file.fail("expected a picture that exists");
  return {path.string(), map.number("tile_m", 1.0), file.place()};
}

}  // namespace stereobench::worlds
