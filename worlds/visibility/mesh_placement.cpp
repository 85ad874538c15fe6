#include "worlds/visibility/mesh_placement.h"

#include "slam/math/elementary.h"

namespace stereobench::worlds {
namespace {

/// The turn about an axis that takes the axis after it towards the one before it.
Eigen::Matrix3d turn_about(int axis, double angle_rad) {
  const auto [s, c] = slam::sine_cosine(angle_rad);
  const int next = (axis + 1) % 3, last = (axis + 2) % 3;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn(next, next) = turn(last, last) = c;
  turn(last, next) = s;
  turn(next, last) = -s;
  return turn;
}

}  // namespace

MeshPlacement placement_of(const MeshInstance& mesh) {
  return {turn_about(2, mesh.heading_rad) * turn_about(1, mesh.pitch_rad) * turn_about(0, mesh.roll_rad),
          mesh.unit_m * mesh.scale, mesh.position_m};
}

Eigen::Affine3d world_from_file(const MeshInstance& mesh) {
  const MeshPlacement placement = placement_of(mesh);
  Eigen::Affine3d world = Eigen::Affine3d::Identity();
  world.linear() = placement.turn * placement.scale.asDiagonal();
  world.translation() = placement.position_m;
  if (mesh.up == MeshUp::kZ) return world;
  Eigen::Matrix3d upright;
  upright << 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0;  // y is up: z points south
  world.linear() *= upright;
  return world;
}

}  // namespace stereobench::worlds
