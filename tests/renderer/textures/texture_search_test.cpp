/// Which files a mesh file may reach by the textures that it names, and what becomes of those it cannot.
#include "renderer/textures/texture_search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "renderer/surfaces/mesh_cache.h"
#include "tests/renderer/folder.h"
#include "tests/renderer/textures/textures.h"

namespace stereobench::renderer {
namespace {

namespace fs = std::filesystem;

using test::Folder;
using testing::ElementsAre;
using testing::HasSubstr;

/// model/meshes/house.obj beside model/materials/textures, with pictures here, there and elsewhere.
class ModelFolder : public testing::Test {
 protected:
  ModelFolder() {
    for (const char* name : {"model/meshes/own", "model/materials/textures", "elsewhere", "model/meshes_2"})
      fs::create_directories(folder_.path() / name);
    for (const char* name : {"model/meshes/own/a.png", "model/materials/textures/b.png", "elsewhere/c.png",
                             "model/meshes_2/d.png", "model/e.png"})
      folder_.write(name, cv::Mat(2, 2, CV_8UC3, cv::Scalar(0, 0, 255)));
    mesh_ = folder_.path() / "model/meshes/house.obj";
  }

  /// A file with a triangle for each texture.
  std::string write_mesh(const std::vector<std::string>& textures) const {
    std::string materials, faces = "mtllib house.mtl\nv 0 0 0\nv 1 0 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\n";
    for (std::size_t i = 0; i < textures.size(); ++i) {
      materials += "newmtl m" + std::to_string(i) + "\nKd 1 1 1\nmap_Kd " + textures[i] + "\n";
      faces += "usemtl m" + std::to_string(i) + "\nf 1/1 2/2 3/3\n";
    }
    folder_.write("model/meshes/house.mtl", materials);
    return folder_.write("model/meshes/house.obj", faces);
  }

  std::string at(const std::string& name) const { return (folder_.path() / name).string(); }
  std::string found(const std::string& name, const std::vector<std::string>& named = {}) const {
    const auto found = TextureFolders(mesh_, named).find(name);
    if (found.leads_out) return "leads out";
    return found.file.empty() ? "nowhere" : fs::relative(found.file, fs::canonical(folder_.path())).string();
  }

  Folder folder_;
  fs::path mesh_;
};

TEST_F(ModelFolder, HasItsTexturesBelowItAndAmongItsMaterials) {
  EXPECT_EQ(found("own/a.png"), "model/meshes/own/a.png");
  EXPECT_EQ(found("own\\a.png"), "model/meshes/own/a.png");
  EXPECT_EQ(found("own/../own/a.png"), "model/meshes/own/a.png");
  EXPECT_EQ(found("b.png"), "model/materials/textures/b.png");
  EXPECT_EQ(found("../materials/textures/b.png"), "model/materials/textures/b.png");
  EXPECT_EQ(found("file:///somebody/elses/b.png"), "model/materials/textures/b.png");
  EXPECT_EQ(found("a.png"), "nowhere");
}

// Red before: all but the last were read. Mutations: no look at links; "meshes_2" begins as "meshes" does.
TEST_F(ModelFolder, IsNotLeft) {
  fs::create_symlink(at("elsewhere/c.png"), at("model/meshes/link.png"));
  fs::create_directory_symlink(at("elsewhere"), at("model/meshes/way"));
  for (const char* name : {"../e.png", "../../elsewhere/c.png", "../meshes_2/d.png", "link.png", "way/c.png",
                           "own/../../e.png", "../materials/e.png"})
    EXPECT_EQ(found(name), "leads out") << name;
  EXPECT_EQ(found(at("elsewhere/c.png")), "leads out");
  EXPECT_EQ(found(at("model/meshes/own/a.png")), "model/meshes/own/a.png");
  fs::create_symlink("loop.png", at("model/meshes/loop.png"));
  EXPECT_NE(found("loop.png"), "loop.png");
}

TEST_F(ModelFolder, IsLeftForFoldersThatTheUserNames) {
  const std::vector<std::string> named = {at("elsewhere")};
  EXPECT_EQ(found("c.png", named), "elsewhere/c.png");
  EXPECT_EQ(found("../../elsewhere/c.png", named), "elsewhere/c.png");
  EXPECT_EQ(found("C:\\Users\\x\\c.png", named), "elsewhere/c.png");
  EXPECT_EQ(found("own/a.png", named), "model/meshes/own/a.png") << "the mesh's own come first";
  EXPECT_EQ(found("../e.png", named), "leads out");
}

TEST_F(ModelFolder, NamesAllThatIsMissingAtOnce) {
  worlds::World world;
  world.meshes = {{.file = write_mesh({"x.png", "own/a.png", "y.png", "../e.png", "x.png"}),
                   .material = worlds::Material::kFile}};
  EXPECT_EQ(test::complaint(world),
            mesh_.string() +
                ": its textures x.png, y.png do not exist, beside it, in ../materials/textures or in "
                "world.texture_folders; its texture ../e.png leads out of the mesh's folder: "
                "world.texture_folders can name others; or draw grey in their place with "
                "world.missing_texture: grey");
  world.texture_search.folders = {at("model")};
  EXPECT_THAT(test::complaint(world), Not(HasSubstr("e.png")));
}

TEST_F(ModelFolder, ShowsGreyWhereItIsAllowed) {
  worlds::World world;
  world.light = {.towards_light = {0.0, 0.0, 1.0}, .ambient = 1.0, .diffuse = 0.0};
  world.meshes = {{.file = write_mesh({"x.png"}), .material = worlds::Material::kFile}};
  world.texture_search.missing = worlds::MissingTexturePolicy::kGrey;
  EXPECT_EQ(test::complaint(world), "no complaint");
  const MeshSurfaces placed = place_meshes(world);
  ASSERT_EQ(placed.textures.size(), 1U);
  EXPECT_NEAR(test::light_of(placed.textures[0].rgb.at(0)), 0.5, 0.005);
  MeshCache cache;
  EXPECT_THAT(cache.missing_textures(world), ElementsAre(HasSubstr("its texture x.png does not exist")));
}

}  // namespace
}  // namespace stereobench::renderer
