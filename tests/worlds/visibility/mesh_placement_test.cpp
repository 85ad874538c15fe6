/// Where meshes' points go, against Eigen's rotations one after another.
#include "worlds/visibility/mesh_placement.h"

#include <gtest/gtest.h>

#include "tests/worlds/visibility/triangles.h"

namespace stereobench::worlds {
namespace {

TEST(MeshPlacement, ScalesThenTurnsAboutXThenYThenZThenMoves) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    slam::RandomStream draws(seed, slam::Stream::kWorld);
    MeshInstance mesh;
    mesh.roll_rad = 7.0 * draws.uniform() - 3.5;
    mesh.pitch_rad = 7.0 * draws.uniform() - 3.5;
    mesh.heading_rad = 7.0 * draws.uniform() - 3.5;
    mesh.scale = random_in_box(draws, 2.0);
    mesh.unit_m = 0.1 + draws.uniform();
    mesh.position_m = random_in_box(draws, 9.0);
    mesh.up = seed % 2 == 0 ? MeshUp::kZ : MeshUp::kY;
    const Eigen::Vector3d point = random_in_box(draws, 3.0);
    Eigen::Vector3d expected = point;
    if (mesh.up == MeshUp::kY) expected = {point.x(), -point.z(), point.y()};
    expected = mesh.unit_m * mesh.scale.cwiseProduct(expected);
    expected = Eigen::AngleAxisd(mesh.roll_rad, Eigen::Vector3d::UnitX()) * expected;
    expected = Eigen::AngleAxisd(mesh.pitch_rad, Eigen::Vector3d::UnitY()) * expected;
    expected = Eigen::AngleAxisd(mesh.heading_rad, Eigen::Vector3d::UnitZ()) * expected;
    expected += mesh.position_m;
    EXPECT_LT((world_from_file(mesh) * point - expected).norm(), 1e-13) << seed;
  }
}

}  // namespace
}  // namespace stereobench::worlds
