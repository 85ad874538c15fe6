#include "renderer/meshes/mesh_bytes.h"

#include <cstring>
#include <stdexcept>

namespace stereobench::renderer {
namespace {

constexpr std::size_t kTriangleBytes = 21 * sizeof(double) + 15 * sizeof(float) + sizeof(int);

/// Writes values one behind another.
class Writer {
 public:
  explicit Writer(std::string& bytes) : bytes_(&bytes) {}

  template <typename Value>
  void operator()(const Value& value, std::size_t count = 1) {
    bytes_->append(reinterpret_cast<const char*>(&value), count * sizeof(Value));
  }
  void text(const std::string& text) {
    (*this)(text.size());
    bytes_->append(text);
  }

 private:
  std::string* bytes_;
};

/// Reads them.
class Reader {
 public:
  explicit Reader(const std::string& bytes) : from_(bytes.data()), left_(bytes.size()) {}

  template <typename Value>
  void operator()(Value& value, std::size_t count = 1) {
    need(count, sizeof(Value));
    std::memcpy(&value, from_, count * sizeof(Value));
    from_ += count * sizeof(Value);
    left_ -= count * sizeof(Value);
  }
  void text(std::string& text) {
    std::size_t size = 0;
    (*this)(size);
    need(size, 1);
    text.assign(from_, size);
    from_ += size;
    left_ -= size;
  }
  /// Checks that so many things are still there.
  void need(std::size_t count, std::size_t each) const {
    if (count > left_ / each) throw std::runtime_error("what was read of it is cut off");
  }

 private:
  const char* from_;
  std::size_t left_;
};

/// What a triangle is made of, in order.
template <typename Pass, typename SomeTriangle>
void pass_triangle(Pass& pass, SomeTriangle& triangle) {
  for (auto& corner : triangle.corners) pass(*corner.data(), 3);
  for (auto& normal : triangle.normals) pass(*normal.data(), 3);
  pass(*triangle.colour_rgb.data(), 3);
  for (auto& colour : triangle.corner_rgb) pass(*colour.data(), 3);
  for (auto& place : triangle.place_px) pass(*place.data(), 2);
  pass(triangle.texture);
}

template <typename Pass, typename SomeTexture>
void pass_texture(Pass& pass, SomeTexture& texture) {
  pass(texture.width_px);
  pass(texture.height_px);
  pass(texture.repeats);
}

}  // namespace

std::string packed(const Mesh& mesh) {
  std::string bytes;
  bytes.reserve(mesh.triangles.size() * kTriangleBytes + 16);
  Writer write(bytes);
  write(mesh.triangles.size());
  for (const Triangle& triangle : mesh.triangles) pass_triangle(write, triangle);
  write(mesh.textures.size());
  for (const Texture& texture : mesh.textures) {
    pass_texture(write, texture);
    write(*texture.rgb.data(), texture.rgb.size());
  }
  write(mesh.missing_textures.size());
  for (const MissingTexture& texture : mesh.missing_textures) {
    write.text(texture.name);
    write(texture.leads_out);
  }
  return bytes;
}

Mesh unpacked(const std::string& bytes) {
  Mesh mesh;
  Reader read(bytes);
  std::size_t count = 0;
  read(count);
  read.need(count, kTriangleBytes);
  mesh.triangles.resize(count);
  for (Triangle& triangle : mesh.triangles) pass_triangle(read, triangle);
  read(count);
  read.need(count, 1);
  mesh.textures.resize(count);
  for (Texture& texture : mesh.textures) {
    pass_texture(read, texture);
    const std::size_t size =
        3 * static_cast<std::size_t>(texture.width_px) * static_cast<std::size_t>(texture.height_px);
    read.need(size, 1);
    texture.rgb.resize(size);
    read(*texture.rgb.data(), size);
  }
  read(count);
  read.need(count, 1);
  mesh.missing_textures.resize(count);
  for (MissingTexture& texture : mesh.missing_textures) {
    read.text(texture.name);
    read(texture.leads_out);
  }
  return mesh;
}

}  // namespace stereobench::renderer
