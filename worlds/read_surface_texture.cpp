#include "worlds/scenario_parts.h"

namespace stereobench::worlds {

SurfaceTexture read_surface_texture(const YamlValue& value, const std::filesystem::path& folder) {
  const YamlMap map(value, {"file", "tile_m"});
  const YamlValue file = map.at("file");
  const std::filesystem::path path = std::filesystem::absolute(folder / file.text()).lexically_normal();
  if (!std::filesystem::is_regular_file(path)) file.fail("expected a picture that exists");
  return {path.string(), map.number("tile_m", {1e-3, 1e3}, 1.0), file.place()};
}

}  // namespace stereobench::worlds
