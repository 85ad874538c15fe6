/// Mesh files good and bad, written by these tests.

#include "renderer/meshes/mesh_file.h"

#include <ostream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "renderer/renderer.h"
#include "renderer/surfaces/mesh_surfaces.h"
#include "tests/complaint.h"
#include "tests/renderer/folder.h"
#include "tests/renderer/random_scene.h"

namespace stereobench::renderer {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string written(const std::string& name, const std::string& text) {
  return test::folder_of_this_process().write(name, text);
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

/// The corners of one triangle of the world, placed, in metres.
std::vector<Eigen::Vector3d> placed_corners(const worlds::MeshInstance& mesh) {
  worlds::World world;
  world.meshes = {mesh};
  std::vector<Eigen::Vector3d> corners;
  for (const SurfaceVertex& vertex : place_meshes(world).vertices)
    corners.push_back(Eigen::Vector3f(vertex.position).cast<double>());
  return corners;
}

// Mutation tried: the unit forgotten. Meant to catch: up y as (x, z, -y); turned in the other order.
TEST(MeshFile, TakesUnitUpAxisAndFullPose) {
  const std::string file = written("mesh_posed.obj", "v 10 0 0\nv 0 20 0\nv 0 0 40\nf 1 2 3\n");
  worlds::MeshInstance mesh{file};
  mesh.unit_m = 0.1;
  mesh.up = worlds::MeshUp::kY;  // the corners become (1, 0, 0), (0, 0, 2), (0, -4, 0)
  mesh.scale = {3.0, 1.0, 0.5};  // (3, 0, 0), (0, 0, 1), (0, -4, 0)
  mesh.roll_rad = M_PI / 2;      // about x: (3, 0, 0), (0, -1, 0), (0, 0, -4)
  mesh.pitch_rad = M_PI / 2;     // about y: (0, 0, -3), (0, -1, 0), (-4, 0, 0)
  mesh.heading_rad = M_PI / 2;   // about z: (0, 0, -3), (1, 0, 0), (0, -4, 0)
  mesh.position_m = {5.0, 6.0, 7.0};
  const std::vector<Eigen::Vector3d> corners = placed_corners(mesh);
  ASSERT_EQ(corners.size(), 3U);
  EXPECT_TRUE(corners[0].isApprox(Eigen::Vector3d(5.0, 6.0, 4.0), 1e-6)) << corners[0].transpose();
  EXPECT_TRUE(corners[1].isApprox(Eigen::Vector3d(6.0, 6.0, 7.0), 1e-6)) << corners[1].transpose();
  EXPECT_TRUE(corners[2].isApprox(Eigen::Vector3d(5.0, 2.0, 7.0), 1e-6)) << corners[2].transpose();
}

const char* const kTwoColours =
    "newmtl red\nKd 0.5 0.25 0.125\nnewmtl odd\nKd 2 -1 0.5\n";  // the second is out of range

// Meant to catch: the colours of the first material for all; runs that do not end where the colour does.
TEST(MeshFile, GivesEachPartTheColourOfItsMaterial) {
  written("mesh_two.mtl", kTwoColours);
  const std::string file = written("mesh_two.obj",
                                   "mtllib mesh_two.mtl\nv 0 0 0\nv 1 0 0\nv 0 0 1\nv 1 0 1\n"
                                   "usemtl red\nf 1 2 3\nusemtl odd\nf 2 4 3\n");
  worlds::World world;
  world.meshes = {{file, {0, 0, 0}, 0.0, {1, 1, 1}, worlds::Material::kFile}, {file}};
  const MeshSurfaces placed = place_meshes(world);
  ASSERT_EQ(placed.runs.size(), 3U) << "a material of ours has one run, whatever the file's colours";
  EXPECT_TRUE(placed.runs[0].tint_rgb.isApprox(Eigen::Vector3f(0.5F, 0.25F, 0.125F)));
  EXPECT_TRUE(placed.runs[1].tint_rgb.isApprox(Eigen::Vector3f(1.0F, 0.0F, 0.5F)));
  EXPECT_EQ(placed.runs[1].first, 3);
  EXPECT_EQ(placed.runs[2].count, 6);
}

// A wall that a file describes once for each side, red to the south and green to the north. Mutation
// tried: the other side culled.
TEST(MeshFile, ShowsOfAWallWithTwoFacesTheOneThatFacesTheCamera) {
  written("mesh_sides.mtl", "newmtl red\nKd 1 0 0\nnewmtl green\nKd 0 1 0\n");
  const std::string file = written("mesh_sides.obj",
                                   "mtllib mesh_sides.mtl\nv -5 0 -5\nv 5 0 -5\nv 0 0 9\n"
                                   "usemtl red\nf 1 2 3\nusemtl green\nf 2 1 3\n");
  worlds::World world;
  world.meshes = {{file, {0, 0, 0}, 0.0, {1, 1, 1}, worlds::Material::kFile}};
  const vision::StereoRig rig = test::small_rig();
  Renderer renderer(world, rig);
  const auto middle = [&](const slam::Pose& pose) {
    const cv::Mat colour = renderer.render(pose).left.colour;
    return colour.at<cv::Vec3b>(colour.rows / 2, colour.cols / 2);
  };
  const cv::Vec3b from_south = middle({0.0, -2.0, M_PI / 2});
  const cv::Vec3b from_north = middle({0.0, 2.0, -M_PI / 2});
  EXPECT_GT(from_south[2], 50);
  EXPECT_EQ(from_south[1], 0);
  EXPECT_GT(from_north[1], 50);
  EXPECT_EQ(from_north[2], 0);
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

void PrintTo(const BadFile& value, std::ostream* out) {
  *out << value.name;
}

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

/// `count` triangles, each with corners of its own.
std::string many_triangles(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n";
  return text;
}

// Meant to catch: each check dropped; `>=` for `>` in the count.
TEST(MeshFile, KeepsToItsLimits) {
  const std::string file = written("mesh_many.obj", many_triangles(40000));  // 1.5 MB
  EXPECT_EQ(read_mesh(file, {.triangles = 40000}).size(), 40000U);
  EXPECT_EQ(complaint_of([&] { read_mesh(file, {.triangles = 39999}); }),
            file + ": has more than 39999 triangles");
  EXPECT_EQ(complaint_of([&] { read_mesh(file, {.file_mib = 1}); }), file + ": is larger than 1 MiB");
  EXPECT_EQ(complaint_of([&] { read_mesh(file, {.seconds = 0.001}); }), file + ": takes longer than 0.001 s");
  worlds::World world;
  world.meshes = {{file}, {file}, {file}};
  world.mesh_limits.triangles = 120000;
  EXPECT_EQ(place_meshes(world).vertices.size(), 360000U);
  world.mesh_limits.triangles = 119999;
  EXPECT_EQ(complaint_of([&] { place_meshes(world); }),
            file + ": with it the world has more than 119999 triangles");
}

// An OBJ index may be a gigabyte away from its file's size: nothing that a small file says may cost much.
TEST(MeshFile, EndsAFileThatEatsMemory) {
  const std::string file = written("mesh_hungry.obj", many_triangles(200000));  // 7 MB, 200 MB when read
  const std::string said = complaint_of([&] { read_mesh(file, {.memory_mib = 20}); });
#ifdef __SANITIZE_ADDRESS__
  EXPECT_THAT(said, HasSubstr(file + ": crashed"));  // its allocator ends the process by itself
#else
  EXPECT_EQ(said, file + ": needs more than 20 MiB of memory");
#endif
}

TEST(MeshFile, SaysThatAFileIsMissing) {
  EXPECT_THAT([] { read_mesh("/nowhere/door.obj"); },
              testing::ThrowsMessage<std::runtime_error>(HasSubstr("/nowhere/door.obj: there is no such")));
}

}  // namespace
}  // namespace stereobench::renderer
