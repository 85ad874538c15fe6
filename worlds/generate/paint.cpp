#include "worlds/generate/paint.h"

#include <array>

#include "vision/palette.h"

namespace stereobench::worlds {
namespace {

constexpr std::array<const char*, 3> kChannels = {".red", ".green", ".blue"};

std::vector<std::string_view> names_of(const std::vector<Material>& materials) {
  std::vector<std::string_view> names;
  for (const Material material : materials)
    names.push_back(kMaterialNames[static_cast<std::size_t>(material)]);
  return names;
}

/// What stands behind the last slash.
std::string_view file_name(std::string_view path) {
  return path.substr(path.rfind('/') + 1);
}

}  // namespace

Eigen::Vector3d palette_rgb(int colour) {
  const vision::PaletteColour& c = vision::kPalette.at(static_cast<std::size_t>(colour));
  return {c.r / 255.0, c.g / 255.0, c.b / 255.0};
}

Eigen::Vector3d paint_of(const Ball& ball) {
  return ball.paint_rgb.value_or(palette_rgb(ball.colour));
}

Eigen::Vector3d draw_paint(KeyedSampler& draws, const std::string& name, int colour, const Range& shade,
                           const Range& tint) {
  Eigen::Vector3d paint = draws.number(name + ".shade", shade) * palette_rgb(colour);
  for (int i = 0; i < 3; ++i) paint[i] += draws.number(name + kChannels[static_cast<std::size_t>(i)], tint);
  return paint.cwiseMax(0.0).cwiseMin(1.0);
}

Eigen::Vector3d draw_tint(KeyedSampler& draws, const std::string& name, const SurfaceLooks& looks) {
  Eigen::Vector3d tint = Eigen::Vector3d::Constant(draws.number(name + ".shade", looks.shade));
  for (int i = 0; i < 3; ++i)
    tint[i] *= 1.0 + draws.number(name + kChannels[static_cast<std::size_t>(i)], looks.tint);
  return tint;
}

Material draw_material(KeyedSampler& draws, const std::string& name, const SurfaceLooks& looks) {
  return looks.materials[draws.choice(name + ".material", names_of(looks.materials))];
}

void draw_surface(KeyedSampler& draws, const std::string& name, const SurfaceLooks& looks, Material& material,
                  SurfaceTexture& texture) {
  std::vector<std::string_view> names = names_of(looks.materials);
  for (const SurfaceTexture& other : looks.textures) names.push_back(file_name(other.file));
  const std::size_t drawn = draws.choice(name + ".material", names);
  const bool has_texture = drawn >= looks.materials.size();
  material = has_texture ? Material::kFile : looks.materials[drawn];
  texture = has_texture ? looks.textures[drawn - looks.materials.size()] : SurfaceTexture{};
}

MeshShape draw_shape(KeyedSampler& draws, const std::string& key, const std::vector<MeshShape>& shapes) {
  std::vector<std::string_view> names;
  for (const MeshShape shape : shapes) names.push_back(kShapeNames[static_cast<std::size_t>(shape) - 1]);
  return shapes[draws.choice(key, names)];
}

}  // namespace stereobench::worlds
