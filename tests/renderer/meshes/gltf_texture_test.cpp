/// Textures of glTF files, versions 1.0 and 2.0, which these tests write themselves.
#include <cmath>
#include <cstring>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "renderer/meshes/mesh_file.h"
#include "renderer/renderer.h"
#include "tests/renderer/folder.h"
#include "tests/renderer/random_scene.h"
#include "tests/renderer/textures/textures.h"

namespace stereobench::renderer {
namespace {

using test::Folder;
using test::light_of;

std::string base64(const std::string& bytes) {
  constexpr const char* kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8U | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? kLetters[bits >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

/// A square upright at x = 0 that faces west, its corners from the lower left, with two sets of places on
/// textures: the picture upright, and all of it at its upper left corner.
std::string buffer() {
  const float corners[] = {0, 1, 0, 0, -1, 0, 0, -1, 2, 0, 1, 2};
  const float places[] = {0, 1, 1, 1, 1, 0, 0, 0}, elsewhere[8] = {};
  const std::uint16_t indices[] = {0, 1, 2, 0, 2, 3};
  std::string bytes;
  const auto append = [&](const auto& list) {
    bytes.append(reinterpret_cast<const char*>(list), sizeof list);
  };
  append(corners);
  append(places);
  append(elsewhere);
  append(indices);
  return "data:application/octet-stream;base64," + base64(bytes);
}

/// @param texture what the material says of its texture, beyond its index
std::string gltf_2(const std::string& texture) {
  return fmt::format(R"({{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}],
"nodes": [{{"mesh": 0}}], "extensionsUsed": ["KHR_texture_transform"],
"meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0, "TEXCOORD_0": 1, "TEXCOORD_1": 2}}, "indices": 3,
  "material": 0}}]}}],
"materials": [{{"pbrMetallicRoughness": {{"baseColorTexture": {{"index": 0{}}}}}}}],
"textures": [{{"source": 0}}], "images": [{{"uri": "p.png"}}],
"accessors": [
  {{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, -1, 0], "max": [0, 1, 2]}},
  {{"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"}},
  {{"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC2"}},
  {{"bufferView": 3, "componentType": 5123, "count": 6, "type": "SCALAR"}}],
"bufferViews": [{{"buffer": 0, "byteOffset": 0, "byteLength": 48}},
  {{"buffer": 0, "byteOffset": 48, "byteLength": 32}}, {{"buffer": 0, "byteOffset": 80, "byteLength": 32}},
  {{"buffer": 0, "byteOffset": 112, "byteLength": 12}}],
"buffers": [{{"byteLength": 124, "uri": "{}"}}]}})",
                     texture, buffer());
}

/// @param diffuse the value of the material, e.g. "\"texture\""
std::string gltf_1(const std::string& diffuse) {
  return fmt::format(R"({{"asset": {{"version": "1.0"}}, "scene": "s", "scenes": {{"s": {{"nodes": ["n"]}}}},
"nodes": {{"n": {{"meshes": ["m"]}}}},
"meshes": {{"m": {{"primitives": [{{"attributes": {{"POSITION": "corners", "TEXCOORD_0": "places"}},
  "indices": "faces", "material": "shown", "mode": 4}}]}}}},
"materials": {{"shown": {{"values": {{"diffuse": {}}}}}}},
"textures": {{"texture": {{"source": "picture", "sampler": "all", "format": 6408, "target": 3553}}}},
"samplers": {{"all": {{"wrapS": 10497, "wrapT": 10497}}}},
"images": {{"picture": {{"uri": "p.png"}}}},
"accessors": {{
  "corners": {{"bufferView": "a", "byteOffset": 0, "componentType": 5126, "count": 4, "type": "VEC3"}},
  "places": {{"bufferView": "b", "byteOffset": 0, "componentType": 5126, "count": 4, "type": "VEC2"}},
  "faces": {{"bufferView": "c", "byteOffset": 0, "componentType": 5123, "count": 6, "type": "SCALAR"}}}},
"bufferViews": {{"a": {{"buffer": "b", "byteOffset": 0, "byteLength": 48, "target": 34962}},
  "b": {{"buffer": "b", "byteOffset": 48, "byteLength": 32, "target": 34962}},
  "c": {{"buffer": "b", "byteOffset": 112, "byteLength": 12, "target": 34963}}}},
"buffers": {{"b": {{"byteLength": 124, "type": "arraybuffer", "uri": "{}"}}}}}})",
                     diffuse, buffer());
}

/// Four quarters: red, green above; blue, white below.
cv::Mat quarters() {
  cv::Mat bgr(16, 16, CV_8UC3);
  bgr(cv::Rect(0, 0, 8, 8)).setTo(cv::Scalar(0, 0, 240));
  bgr(cv::Rect(8, 0, 8, 8)).setTo(cv::Scalar(0, 240, 0));
  bgr(cv::Rect(0, 8, 8, 8)).setTo(cv::Scalar(240, 0, 0));
  bgr(cv::Rect(8, 8, 8, 8)).setTo(cv::Scalar(240, 240, 240));
  return bgr;
}

/// What is seen of the square's quarters, one after another along the rows, as letters of their colours.
std::string seen_quarters(const std::string& file) {
  worlds::World world;
  world.light = {.towards_light = {0.0, 0.0, 1.0}, .ambient = 1.0, .diffuse = 0.0};
  world.meshes = {{file, {2.0, 0.0, 0.05}, 0.0, {1.0, 0.4, 0.4}, worlds::Material::kFile}};
  vision::StereoRig rig = test::small_rig();
  rig.pitch_down_rad = 0.0;
  const cv::Mat colour = Renderer(world, rig).render({}).left.colour;
  const double reach_px = 0.2 * rig.intrinsics.focal_px / 2.0;  // to the middle of a quarter
  const double x_px = rig.intrinsics.cx_px + 0.5 * rig.baseline_m * rig.intrinsics.focal_px / 2.0;
  const double y_px = rig.intrinsics.cy_px - (0.45 - rig.height_m) * rig.intrinsics.focal_px / 2.0;
  std::string letters;
  for (const double y : {y_px - reach_px, y_px + reach_px})
    for (const double x : {x_px - reach_px, x_px + reach_px}) {
      const cv::Vec3b bgr =
          colour.at<cv::Vec3b>(static_cast<int>(std::lround(y)), static_cast<int>(std::lround(x)));
      letters += bgr[0] > 100 && bgr[1] > 100 ? 'w'
                 : bgr[0] > 100               ? 'b'
                 : bgr[1] > 100               ? 'g'
                 : bgr[2] > 100               ? 'r'
                                              : '-';
    }
  return letters;
}

// A material of glTF 1.0 has a colour or a texture. Red before: a colour that is not there was black.
TEST(Gltf, OfVersionOneShowsItsTexture) {
  const Folder folder;
  folder.write("p.png", quarters());
  EXPECT_EQ(seen_quarters(folder.write("one.gltf", gltf_1("\"texture\""))), "rgbw");
  const Mesh coloured = read_textured_mesh(folder.write("grey.gltf", gltf_1("[0.5, 0.25, 1, 1]")));
  EXPECT_TRUE(coloured.textures.empty());
  EXPECT_TRUE(coloured.triangles.front().colour_rgb.isApprox(Eigen::Vector3d(0.5, 0.25, 1.0)));
}

TEST(Gltf, OfVersionTwoShowsItsTexture) {
  const Folder folder;
  folder.write("p.png", quarters());
  EXPECT_EQ(seen_quarters(folder.write("two.gltf", gltf_2(""))), "rgbw");
}

// Red before: the first set whatever the material says.
TEST(Gltf, ShowsTheSetOfPlacesThatItsMaterialNames) {
  const Folder folder;
  folder.write("p.png", quarters());
  const Mesh mesh = read_textured_mesh(folder.write("two.gltf", gltf_2(R"(, "texCoord": 1)")));
  ASSERT_EQ(mesh.triangles.size(), 2U);
  for (const Triangle& triangle : mesh.triangles)
    for (const Eigen::Vector2f& place : triangle.place_px) EXPECT_EQ(place, Eigen::Vector2f(0.0F, 0.0F));
}

std::string transform(double x, double y, double rotation_rad, double scale_x, double scale_y) {
  return fmt::format(
      R"(, "extensions": {{"KHR_texture_transform": {{"offset": [{}, {}], "rotation": {}, "scale": [{}, {}]}}}})",
      x, y, rotation_rad, scale_x, scale_y);
}

// The specification's own examples: the lower left quadrant alone, turned clockwise by 90 degrees; and the
// picture upside down. The first is red with assimp's own transform.
TEST(Gltf, TransformsItsTextureAsTheSpecificationsExamplesSay) {
  const Folder folder;
  cv::Mat picture = quarters(), corner(8, 8, CV_8UC3);
  corner(cv::Rect(0, 0, 4, 4)).setTo(cv::Scalar(240, 0, 0));
  corner(cv::Rect(4, 0, 4, 4)).setTo(cv::Scalar(0, 240, 0));
  corner(cv::Rect(0, 4, 4, 4)).setTo(cv::Scalar(0, 0, 240));
  corner(cv::Rect(4, 4, 4, 4)).setTo(cv::Scalar(240, 240, 240));
  corner.copyTo(picture(cv::Rect(0, 8, 8, 8)));  // bg over rw; clockwise: rb over wg
  folder.write("p.png", picture);
  EXPECT_EQ(seen_quarters(folder.write("a.gltf", gltf_2(transform(0, 1, M_PI / 2, 0.5, 0.5)))), "rbwg");
  folder.write("p.png", quarters());
  EXPECT_EQ(seen_quarters(folder.write("b.gltf", gltf_2(transform(0, 1, 0, 1, -1)))), "bwrg");
}

// Law: places are scaled, turned counter-clockwise about the upper left corner, and moved, whatever the
// numbers. Mutations: turned the other way; moved before it is scaled; turned about the middle.
TEST(Gltf, TransformsEveryPlace) {
  const Folder folder;
  folder.write("p.png", cv::Mat(10, 20, CV_8UC3, cv::Scalar(1, 2, 3)));
  const double numbers[][5] = {{0.3, -0.2, 0, 1, 1},    {0, 0, 0.7, 1, 1},      {0, 0, 0, 3, 0.4},
                               {0.1, 0.6, 0, 2, -1.5},  {-0.4, 0.2, 1.1, 2, 2}, {0.25, 0.5, -2.2, 0.6, 1.7},
                               {1.5, -2.5, 3.0, -2, 5}, {0, 0, M_PI / 2, 1, 2}};
  for (const auto& [x, y, rotation, scale_x, scale_y] : numbers) {
    const Mesh mesh =
        read_textured_mesh(folder.write("moved.gltf", gltf_2(transform(x, y, rotation, scale_x, scale_y))));
    ASSERT_EQ(mesh.triangles.size(), 2U);
    for (const Triangle& triangle : mesh.triangles)
      for (int i = 0; i < 3; ++i) {
        const Eigen::Vector3d& corner = triangle.corners[i];
        const double u = scale_x * (1.0 - corner.y()) / 2.0, v = scale_y * (2.0 - corner.z()) / 2.0;
        const double c = std::cos(rotation), s = std::sin(rotation);
        EXPECT_NEAR(double{triangle.place_px[i].x()}, 20.0 * (x + c * u + s * v), 1e-4);
        EXPECT_NEAR(double{triangle.place_px[i].y()}, 10.0 * (y - s * u + c * v), 1e-4);
      }
  }
}

}  // namespace
}  // namespace stereobench::renderer
