#include "renderer/mesh_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>

#include <Eigen/Geometry>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/core.h>

#include "renderer/child_call.h"

namespace stereobench::renderer {
namespace {

constexpr std::array<std::string_view, 6> kEndings = {".obj", ".dae", ".gltf", ".glb", ".stl", ".fbx"};
constexpr double kFarthest = 1e6;  // mesh units: beyond, single precision has nothing left for the shape
constexpr unsigned kSteps =
    aiProcess_Triangulate | aiProcess_PreTransformVertices | aiProcess_ValidateDataStructure;

constexpr std::size_t kTriangleNumbers = 21;  // corners, normals, colour: what a triangle is in a pipe

/// Which file it is about is added in one place, by read_mesh.
[[noreturn]] void refuse(const std::string& why) {
  throw std::runtime_error(why);
}

void check_ending(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  if (std::find(kEndings.begin(), kEndings.end(), ending) == kEndings.end()) {
    refuse(fmt::format("mesh files end in obj, dae, gltf, glb, stl or fbx, not '{}'", ending));
  }
}

Eigen::Vector3d vector(const aiVector3D& v) {
  return {double{v.x}, double{v.y}, double{v.z}};
}

/// The colour of a material under white light; a light grey where the file does not say.
Eigen::Vector3d diffuse_colour(const aiMaterial& material) {
  aiColor3D colour(0.7F, 0.7F, 0.7F);
  material.Get(AI_MATKEY_COLOR_DIFFUSE, colour);
  const Eigen::Vector3d rgb(double{colour.r}, double{colour.g}, double{colour.b});
  if (!rgb.allFinite()) return Eigen::Vector3d::Constant(0.7);
  return rgb.cwiseMax(0.0).cwiseMin(1.0);
}

Triangle read_triangle(const aiMesh& mesh, const aiFace& face) {
  Triangle triangle;
  for (unsigned i = 0; i < 3; ++i) {
    const unsigned index = face.mIndices[i];
    if (index >= mesh.mNumVertices)
      refuse(fmt::format("a face uses vertex {} of {}", index, mesh.mNumVertices));
    triangle.corners[i] = vector(mesh.mVertices[index]);
    if (!(triangle.corners[i].cwiseAbs().maxCoeff() <= kFarthest)) {
      refuse("a vertex is not finite, or more than a million units away");
    }
  }
  const Eigen::Vector3d edge = triangle.corners[1] - triangle.corners[0];
  const Eigen::Vector3d flat = edge.cross(triangle.corners[2] - triangle.corners[0]).stableNormalized();
  for (unsigned i = 0; i < 3; ++i) {
    const Eigen::Vector3d given = mesh.HasNormals() ? vector(mesh.mNormals[face.mIndices[i]]) : flat;
    triangle.normals[i] = given.allFinite() && given.squaredNorm() > 0.0 ? given.normalized() : flat;
  }
  return triangle;
}

const aiScene& import(Assimp::Importer& importer, const std::filesystem::path& file) {
  const aiScene* scene = importer.ReadFile(file.string(), kSteps);
  if (scene == nullptr) refuse(fmt::format("not a readable mesh: {}", importer.GetErrorString()));
  if ((scene->mFlags & AI_SCENE_FLAGS_INCOMPLETE) != 0) refuse("the mesh is incomplete");
  if (scene->mNumMeshes == 0) refuse("the file has no meshes");
  return *scene;
}

void append(const aiMesh& mesh, const Eigen::Vector3d& colour_rgb, std::vector<Triangle>& triangles) {
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    if (mesh.mFaces[f].mNumIndices != 3) continue;
    triangles.push_back(read_triangle(mesh, mesh.mFaces[f]));
    triangles.back().colour_rgb = colour_rgb;
  }
}

/// What the child does.
std::vector<Triangle> parse(const std::filesystem::path& file, int most_triangles) {
  Assimp::Importer importer;
  const aiScene& scene = import(importer, file);
  std::vector<Triangle> triangles;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[m];
    if (mesh.mMaterialIndex >= scene.mNumMaterials) refuse("a part has a material that does not exist");
    append(mesh, diffuse_colour(*scene.mMaterials[mesh.mMaterialIndex]), triangles);
    if (triangles.size() > static_cast<std::size_t>(most_triangles))
      refuse(fmt::format("has more than {} triangles", most_triangles));
  }
  if (triangles.empty()) refuse("the mesh has no faces");
  return triangles;
}

std::string packed(const std::vector<Triangle>& triangles) {
  std::vector<double> numbers;
  numbers.reserve(triangles.size() * kTriangleNumbers);
  for (const Triangle& t : triangles) {
    for (const Eigen::Vector3d* vectors : {t.corners, t.normals})
      for (int i = 0; i < 3; ++i) numbers.insert(numbers.end(), vectors[i].data(), vectors[i].data() + 3);
    numbers.insert(numbers.end(), t.colour_rgb.data(), t.colour_rgb.data() + 3);
  }
  std::string bytes(numbers.size() * sizeof(double), '\0');
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

std::vector<Triangle> unpacked(const std::string& bytes) {
  if (bytes.empty() || bytes.size() % (kTriangleNumbers * sizeof(double)) != 0)
    refuse("what was read of it is cut off");
  std::vector<Triangle> triangles(bytes.size() / (kTriangleNumbers * sizeof(double)));
  const char* from = bytes.data();
  const auto take = [&](Eigen::Vector3d& vector) {
    std::memcpy(vector.data(), from, 3 * sizeof(double));
    from += 3 * sizeof(double);
  };
  for (Triangle& t : triangles) {
    for (Eigen::Vector3d& corner : t.corners) take(corner);
    for (Eigen::Vector3d& normal : t.normals) take(normal);
    take(t.colour_rgb);
  }
  return triangles;
}

void check_file(const std::filesystem::path& file, const worlds::MeshLimits& limits) {
  check_ending(file);
  if (!std::filesystem::is_regular_file(file)) refuse("there is no such mesh file");
  if (std::filesystem::file_size(file) > static_cast<std::uintmax_t>(limits.file_mib) << 20U)
    refuse(fmt::format("is larger than {} MiB", limits.file_mib));
}

/// A library's complaint, which may quote the file, as one line of decent length.
std::string one_line(std::string text) {
  constexpr std::size_t kLongest = 300;
  std::replace_if(
      text.begin(), text.end(), [](unsigned char letter) { return std::iscntrl(letter) != 0; }, ' ');
  return text.size() > kLongest ? text.substr(0, kLongest) + "..." : text;
}

}  // namespace

std::vector<Triangle> read_mesh(const std::filesystem::path& file, const worlds::MeshLimits& limits) {
  try {
    check_file(file, limits);
    return unpacked(call_in_child([&] { return packed(parse(file, limits.triangles)); },
                                  {limits.seconds, static_cast<std::size_t>(limits.memory_mib) << 20U}));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), one_line(error.what())));
  }
}

}  // namespace stereobench::renderer
