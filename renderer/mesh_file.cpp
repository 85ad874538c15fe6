#include "renderer/mesh_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <stdexcept>
#include <string>
#include <string_view>

#include <Eigen/Geometry>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/core.h>

namespace stereobench::renderer {
namespace {

constexpr std::array<std::string_view, 6> kEndings = {".obj", ".dae", ".gltf", ".glb", ".stl", ".fbx"};
constexpr double kFarthest = 1e6;  // mesh units: beyond, single precision has nothing left for the shape
constexpr unsigned kSteps =
    aiProcess_Triangulate | aiProcess_PreTransformVertices | aiProcess_ValidateDataStructure;

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
  throw std::runtime_error(fmt::format("{}: {}", file.string(), why));
}

void check_ending(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  if (std::find(kEndings.begin(), kEndings.end(), ending) == kEndings.end()) {
    refuse(file, fmt::format("mesh files end in obj, dae, gltf, glb, stl or fbx, not '{}'", ending));
  }
}

Eigen::Vector3d vector(const aiVector3D& v) {
  return {double{v.x}, double{v.y}, double{v.z}};
}

Triangle read_triangle(const std::filesystem::path& file, const aiMesh& mesh, const aiFace& face) {
  Triangle triangle;
  for (unsigned i = 0; i < 3; ++i) {
    const unsigned index = face.mIndices[i];
    if (index >= mesh.mNumVertices)
      refuse(file, fmt::format("a face uses vertex {} of {}", index, mesh.mNumVertices));
    triangle.corners[i] = vector(mesh.mVertices[index]);
    if (!(triangle.corners[i].cwiseAbs().maxCoeff() <= kFarthest)) {
      refuse(file, "a vertex is not finite, or more than a million units away");
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
  if (!std::filesystem::is_regular_file(file)) refuse(file, "there is no such mesh file");
  const aiScene* scene = importer.ReadFile(file.string(), kSteps);
  if (scene == nullptr) refuse(file, fmt::format("not a readable mesh: {}", importer.GetErrorString()));
  if ((scene->mFlags & AI_SCENE_FLAGS_INCOMPLETE) != 0) refuse(file, "the mesh is incomplete");
  if (scene->mNumMeshes == 0) refuse(file, "the file has no meshes");
  return *scene;
}

}  // namespace

std::vector<Triangle> read_mesh(const std::filesystem::path& file) {
  check_ending(file);
  Assimp::Importer importer;
  const aiScene& scene = import(importer, file);
  std::vector<Triangle> triangles;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[m];
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      if (mesh.mFaces[f].mNumIndices == 3) triangles.push_back(read_triangle(file, mesh, mesh.mFaces[f]));
    }
  }
  if (triangles.empty()) refuse(file, "the mesh has no faces");
  return triangles;
}

}  // namespace stereobench::renderer
