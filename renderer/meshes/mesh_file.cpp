#include "renderer/meshes/mesh_file.h"

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

#include "renderer/meshes/mesh_bytes.h"
#include "renderer/meshes/sandboxed_call.h"
#include "renderer/textures/texture_file.h"
#include "renderer/textures/uv_transform.h"

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

std::string ending_of(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return ending;
}

void check_ending(const std::filesystem::path& file) {
  const std::string ending = ending_of(file);
  if (std::find(kEndings.begin(), kEndings.end(), ending) == kEndings.end()) {
    refuse(fmt::format("mesh files end in obj, dae, gltf, glb, stl or fbx, not '{}'", ending));
  }
}

Eigen::Vector3d vector(const aiVector3D& v) {
  return {double{v.x}, double{v.y}, double{v.z}};
}

/// The colour of a material under white light. Where the file does not say it is a light grey, or that of the
/// texture alone.
Eigen::Vector3d diffuse_colour(const aiMaterial& material, bool has_texture) {
  const Eigen::Vector3d unsaid = Eigen::Vector3d::Constant(has_texture ? 1.0 : 0.7);
  aiColor3D colour;  // where there is none, asking for it makes it black
  if (material.Get(AI_MATKEY_COLOR_DIFFUSE, colour) != aiReturn_SUCCESS) return unsaid;
  const Eigen::Vector3d rgb(double{colour.r}, double{colour.g}, double{colour.b});
  return rgb.allFinite() ? rgb.cwiseMax(0.0).cwiseMin(1.0) : unsaid;
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

/// How a material shows a picture.
struct Laid {
  int texture = -1;      ///< index into Mesh::textures
  unsigned channel = 0;  ///< which of a corner's places on textures is meant
  UvTransform transform;
};

/// Where a face's corners lie on a picture; what has no such places has no picture.
void lay_on(const Texture& texture, const Laid& laid, const aiMesh& mesh, const aiFace& face,
            Triangle& triangle) {
  if (!mesh.HasTextureCoords(laid.channel)) return;
  const Eigen::Vector2d size_px(texture.width_px, texture.height_px);
  for (unsigned i = 0; i < 3; ++i) {
    const Eigen::Vector3d from_below = vector(mesh.mTextureCoords[laid.channel][face.mIndices[i]]);
    const Eigen::Vector2d place = laid.transform({from_below.x(), 1.0 - from_below.y()});
    if (!(place.cwiseAbs().maxCoeff() <= kFarthest)) refuse("a place on a texture is not finite, or absurd");
    triangle.place_px[i] = place.cwiseProduct(size_px).cast<float>();
  }
  triangle.texture = laid.texture;
}

/// What is asked of a file.
struct Request {
  const std::filesystem::path& file;
  const worlds::MeshLimits& limits;
  bool with_textures = false;
  const std::vector<std::string>& texture_folders;
};

/// What the child does.
class Parser {
 public:
  explicit Parser(const Request& request)
      : request_(request),
        ending_(ending_of(request.file)),
        folders_(request.file, request.texture_folders),
        scene_(&import(importer_, request.file, moves_textures() ? kTextureSteps : kSteps)) {}

  Mesh parse() {
    for (unsigned m = 0; m < scene_->mNumMeshes; ++m) {
      const aiMesh& mesh = *scene_->mMeshes[m];
      if (mesh.mMaterialIndex >= scene_->mNumMaterials) refuse("a part has a material that does not exist");
      append(mesh);
      if (result_.triangles.size() > static_cast<std::size_t>(request_.limits.triangles))
        refuse(fmt::format("has more than {} triangles", request_.limits.triangles));
    }
    if (result_.triangles.empty()) refuse("the mesh has no faces");
    return std::move(result_);
  }

 private:
  bool is_gltf() const { return ending_ == ".gltf" || ending_ == ".glb"; }
  /// Whether assimp is asked to move places on textures; uv_transform.h says why not those of glTF.
  bool moves_textures() const { return request_.with_textures && !is_gltf(); }

  void append(const aiMesh& mesh) {
    const Laid laid = request_.with_textures ? laid_by(mesh.mMaterialIndex) : Laid{};
    const Eigen::Vector3d colour_rgb = colour_of(*scene_->mMaterials[mesh.mMaterialIndex], laid.texture >= 0);
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices != 3) continue;
      Triangle triangle = read_triangle(mesh, face);
      triangle.colour_rgb = colour_rgb;
      if (request_.with_textures) colour_corners(mesh, face, triangle);
      if (laid.texture >= 0)
        lay_on(result_.textures[static_cast<std::size_t>(laid.texture)], laid, mesh, face, triangle);
      result_.triangles.push_back(triangle);
    }
  }

  /// Collada gives a material a colour or a texture; beside a texture assimp has a grey of its own.
  Eigen::Vector3d colour_of(const aiMaterial& material, bool has_texture) const {
    return has_texture && ending_ == ".dae" ? Eigen::Vector3d::Ones() : diffuse_colour(material, has_texture);
  }

  /// How a material shows its picture, which is read once.
  Laid laid_by(unsigned index) {
    const auto [known, is_new] = laid_.try_emplace(index);
    if (!is_new) return known->second;
    const aiMaterial& material = *scene_->mMaterials[index];
    std::optional<MaterialTexture> shown = read_texture(*scene_, material, folders_, request_.limits);
    if (!shown) return {};
    if (shown->missing) note(*shown->missing);
    Laid& laid = known->second;
    if (int channel = 0; material.Get(AI_MATKEY_UVWSRC(shown->type, 0), channel) == aiReturn_SUCCESS)
      laid.channel = static_cast<unsigned>(channel);
    if (is_gltf()) laid.transform = gltf_transform(material, shown->type);
    result_.textures.push_back(std::move(shown->texture));
    laid.texture = static_cast<int>(result_.textures.size()) - 1;
    return laid;
  }

  void note(const MissingTexture& texture) {
    auto& missing = result_.missing_textures;
    if (std::find(missing.begin(), missing.end(), texture) == missing.end()) missing.push_back(texture);
  }

  Request request_;
  std::string ending_;
  TextureFolders folders_;
  Assimp::Importer importer_;
  const aiScene* scene_;
  std::map<unsigned, Laid> laid_;  // by material
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

Mesh read(const Request& request) {
  try {
    check_file(request.file, request.limits);
    return unpacked(
        call_in_child([&] { return packed(Parser(request).parse()); },
                      {request.limits.seconds, static_cast<std::size_t>(request.limits.memory_mib) << 20U}));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: {}", request.file.string(), one_line(error.what())));
  }
}

}  // namespace

std::vector<Triangle> read_mesh(const std::filesystem::path& file, const worlds::MeshLimits& limits) {
  return read({file, limits, false, {}}).triangles;
}

Mesh read_textured_mesh(const std::filesystem::path& file, const worlds::MeshLimits& limits,
                        const std::vector<std::string>& folders) {
  return read({file, limits, true, folders});
}

}  // namespace stereobench::renderer
