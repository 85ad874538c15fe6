#include "renderer/truth/flat_row.h"

namespace stereobench::renderer {

SceneGeometry::FlatRow::FlatRow(const SceneGeometry& scene, int primitive, const PinholeLook& camera,
                                int row) {
  const Flat& flat = scene.flat(primitive);
  if (flat.shape == Shape::kNothing) return;
  const Eigen::Vector3d from_corner = camera.centre_m - flat.corner;
  const auto along_row = [&](const Eigen::Vector3d& in_world) {
    return AlongRow(camera.turn * in_world, camera.intrinsics, row);
  };
  inverse_depth_ = -1.0 / flat.normal.dot(from_corner) * along_row(flat.normal);
  if (flat.shape == Shape::kPlane) return;
  const AlongRow s = flat.dual_along.dot(from_corner) * inverse_depth_ + along_row(flat.dual_along);
  const AlongRow t = flat.dual_up.dot(from_corner) * inverse_depth_ + along_row(flat.dual_up);
  if (flat.shape == Shape::kParallelogram)
    room_ = {s, t, inverse_depth_ - s, inverse_depth_ - t};
  else
    room_ = {s, t, inverse_depth_ - s - t, {}};
}

}  // namespace stereobench::renderer
