/// Mesh files good and bad.

#include "renderer/mesh_file.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "renderer/mesh_surfaces.h"

namespace stereobench::renderer {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string written(const std::string& name, const std::string& text) {
  const std::string file = testing::TempDir() + "/" + name;
  std::ofstream(file) << text;
  return file;
}

const char* const kSquare = "v 0 0 0\nv 2 0 0\nv 2 0 1\nv 0 0 1\nf 1 2 3 4\n";

TEST(MeshFile, CutsFacesIntoTrianglesWithNormals) {
  const std::vector<Triangle> triangles = read_mesh(written("mesh_square.obj", kSquare));
  ASSERT_EQ(triangles.size(), 2U);
  double area = 0.0;
  for (const Triangle& triangle : triangles) {
    area +=
        0.5 *
        (triangle.corners[1] - triangle.corners[0]).cross(triangle.corners[2] - triangle.corners[0]).norm();
    for (const Eigen::Vector3d& normal : triangle.normals) EXPECT_NEAR(normal.y(), -1.0, 1e-6);
  }
  EXPECT_NEAR(area, 2.0, 1e-6);
}

TEST(MeshFile, PlacesEachInstanceInTheWorldAndReadsAFileOnce) {
  worlds::World world;
  const std::string file = written("mesh_placed.obj", kSquare);
  world.meshes = {{file, {1, 2, 3}, M_PI / 2, {1, 1, 1}, worlds::Material::kWood},
                  {file, {0, 0, 0}, 0.0, {0.5, 1, 3}, worlds::Material::kPlain}};
  const MeshSurfaces placed = place_meshes(world);
  ASSERT_EQ(placed.runs.size(), 2U);
  EXPECT_EQ(placed.runs[1].first, 6);
  EXPECT_EQ(placed.runs[1].count, 6);
  EXPECT_TRUE(placed.runs[0].centre_m.isApprox(Eigen::Vector3d(1.0, 3.0, 3.5), 1e-6));
  EXPECT_TRUE(placed.runs[1].centre_m.isApprox(Eigen::Vector3d(0.5, 0.0, 1.5), 1e-6));
}

TEST(MeshFile, PassesOverLinesAndPoints) {
  const std::string file = written("mesh_lines.obj", std::string(kSquare) + "l 1 3\n");
  EXPECT_EQ(read_mesh(file).size(), 2U);
}

TEST(MeshFile, ReadsTheMeshesThatShipWithTheScenarios) {
  for (const char* name : {"door.obj", "column.obj"}) {
    const std::vector<Triangle> triangles =
        read_mesh(std::string(STEREOBENCH_SOURCE_DIR "/assets/meshes/") + name);
    EXPECT_GE(triangles.size(), 12U) << name;
    double volume = 0.0;  // of a closed shape whose faces look outward
    for (const Triangle& t : triangles) volume += t.corners[0].dot(t.corners[1].cross(t.corners[2])) / 6.0;
    EXPECT_GT(volume, 0.0) << name;
  }
}

struct BadFile {
  std::string name;
  std::string text;
  std::string complaint;
};

class BadMesh : public testing::TestWithParam<BadFile> {};

TEST_P(BadMesh, IsRefusedByName) {
  const BadFile& bad = GetParam();
  const std::string file = written(bad.name, bad.text);
  EXPECT_THAT([&] { read_mesh(file); },
              testing::ThrowsMessage<std::runtime_error>(AllOf(HasSubstr(file), HasSubstr(bad.complaint))));
}

INSTANTIATE_TEST_SUITE_P(
    Files, BadMesh,
    testing::Values(BadFile{"bad.ply", "ply\n", "'.ply'"}, BadFile{"bad.txt", kSquare, "'.txt'"},
                    BadFile{"bad_empty.obj", "", "not a readable mesh"},
                    BadFile{"bad_points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\np 1 2 3\n", "bad_points"},
                    BadFile{"bad_infinite.obj", "v 0 0 0\nv inf 0 0\nv 0 1 0\nf 1 2 3\n", "not finite"},
                    BadFile{"bad_absurd.obj", "v 0 0 0\nv 1e9 0 0\nv 0 1 0\nf 1 2 3\n", "not finite"},
                    BadFile{"bad_json.gltf", "{\"asset\": 3", "not a readable mesh"},
                    BadFile{"bad_xml.dae", "<COLLADA><broken", "not a readable mesh"},
                    BadFile{"bad_bytes.glb", "glTF\x02", "not a readable mesh"},
                    BadFile{"bad_bytes.fbx", "Kaydara FBX Binary  ", "not a readable mesh"}));

TEST(MeshFile, SaysThatAFileIsMissing) {
  EXPECT_THAT([] { read_mesh("/nowhere/door.obj"); },
              testing::ThrowsMessage<std::runtime_error>(HasSubstr("/nowhere/door.obj: there is no such")));
}

}  // namespace
}  // namespace stereobench::renderer
