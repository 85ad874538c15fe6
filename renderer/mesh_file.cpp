#include "renderer/mesh_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <optional>
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
#include "renderer/mesh_bytes.h"
#include "renderer/texture_file.h"

namespace stereobench::renderer {
namespace {

constexpr std::array<std::string_view, 6> kEndings = {".obj", ".dae", ".gltf", ".glb", ".stl", ".fbx"};
constexpr double kFarthest = 1e6;  // mesh units: beyond, single precision has nothing left for the shape
constexpr unsigned kSteps =
    aiProcess_Triangulate | aiProcess_PreTransformVertices | aiProcess_ValidateDataStructure;
constexpr unsigned kTextureSteps = kSteps | aiProcess_TransformUVCoords;

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

const aiScene& import(Assimp::Importer& importer, const std::filesystem::path& file, unsigned steps) {
  const aiScene* scene = importer.ReadFile(file.string(), steps);
  if (scene == nullptr) refuse(fmt::format("not a readable mesh: {}", importer.GetErrorString()));
  if ((scene->mFlags & AI_SCENE_FLAGS_INCOMPLETE) != 0) refuse("the mesh is incomplete");
  if (scene->mNumMeshes == 0) refuse("the file has no meshes");
  return *scene;
}

/// The colours that the file gives a face's corners.
void colour_corners(const aiMesh& mesh, const aiFace& face, Triangle& triangle) {
  if (!mesh.HasVertexColors(0)) return;
  for (unsigned i = 0; i < 3; ++i) {
    const aiColor4D& colour = mesh.mColors[0][face.mIndices[i]];
    const Eigen::Vector3f rgb(colour.r, colour.g, colour.b);
    if (rgb.allFinite()) triangle.corner_rgb[i] = rgb.cwiseMax(0.0F).cwiseMin(1.0F);
  }
}

/// Where a face's corners lie on a picture; what has no such places has no picture.
void lay_on(const Texture& texture, int index, const aiMesh& mesh, const aiFace& face, Triangle& triangle) {
  if (!mesh.HasTextureCoords(0)) return;
  for (unsigned i = 0; i < 3; ++i) {
    const Eigen::Vector3d place = vector(mesh.mTextureCoords[0][face.mIndices[i]]);  // from the lower left
    if (!(place.cwiseAbs().maxCoeff() <= kFarthest)) refuse("a place on a texture is not finite, or absurd");
    triangle.place_px[i] =
        Eigen::Vector2d(place.x() * texture.width_px, (1.0 - place.y()) * texture.height_px).cast<float>();
  }
  triangle.texture = index;
}

/// What the child does.
class Parser {
 public:
  Parser(const std::filesystem::path& file, const worlds::MeshLimits& limits, bool with_textures)
      : limits_(limits), folder_(file.parent_path()), with_textures_(with_textures) {
    scene_ = &import(importer_, file, with_textures ? kTextureSteps : kSteps);
  }

  Mesh parse() {
    for (unsigned m = 0; m < scene_->mNumMeshes; ++m) {
      const aiMesh& mesh = *scene_->mMeshes[m];
      if (mesh.mMaterialIndex >= scene_->mNumMaterials) refuse("a part has a material that does not exist");
      append(mesh);
      if (result_.triangles.size() > static_cast<std::size_t>(limits_.triangles))
        refuse(fmt::format("has more than {} triangles", limits_.triangles));
    }
    if (result_.triangles.empty()) refuse("the mesh has no faces");
    return std::move(result_);
  }

 private:
  void append(const aiMesh& mesh) {
    const Eigen::Vector3d colour_rgb = diffuse_colour(*scene_->mMaterials[mesh.mMaterialIndex]);
    const int texture = with_textures_ ? texture_of(mesh.mMaterialIndex) : -1;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices != 3) continue;
      Triangle triangle = read_triangle(mesh, face);
      triangle.colour_rgb = colour_rgb;
      if (with_textures_) colour_corners(mesh, face, triangle);
      if (texture >= 0)
        lay_on(result_.textures[static_cast<std::size_t>(texture)], texture, mesh, face, triangle);
      result_.triangles.push_back(triangle);
    }
  }

  /// The index of a material's picture, read once; -1 where it has none.
  int texture_of(unsigned material) {
    const auto [known, is_new] = textures_.try_emplace(material, -1);
    if (!is_new) return known->second;
    std::optional<Texture> texture = read_texture(*scene_, *scene_->mMaterials[material], folder_, limits_);
    if (!texture) return -1;
    result_.textures.push_back(*std::move(texture));
    return known->second = static_cast<int>(result_.textures.size()) - 1;
  }

  const worlds::MeshLimits& limits_;
  std::filesystem::path folder_;
  bool with_textures_;
  Assimp::Importer importer_;
  const aiScene* scene_ = nullptr;
  std::map<unsigned, int> textures_;  // by material
  Mesh result_;
};

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

Mesh read(const std::filesystem::path& file, const worlds::MeshLimits& limits, bool with_textures) {
  try {
    check_file(file, limits);
    return unpacked(call_in_child([&] { return packed(Parser(file, limits, with_textures).parse()); },
                                  {limits.seconds, static_cast<std::size_t>(limits.memory_mib) << 20U}));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), one_line(error.what())));
  }
}

}  // namespace

std::vector<Triangle> read_mesh(const std::filesystem::path& file, const worlds::MeshLimits& limits) {
  return read(file, limits, false).triangles;
}

Mesh read_textured_mesh(const std::filesystem::path& file, const worlds::MeshLimits& limits) {
  return read(file, limits, true);
}

}  // namespace stereobench::renderer
