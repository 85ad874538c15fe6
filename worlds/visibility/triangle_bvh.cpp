#include "worlds/visibility/triangle_bvh.h"

namespace stereobench::worlds {
namespace {

std::vector<Eigen::AlignedBox3d> boxes_of(const std::vector<TriangleCorners>& triangles) {
  std::vector<Eigen::AlignedBox3d> boxes(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (const Eigen::Vector3d& corner : triangles[i]) boxes[i].extend(corner);
  return boxes;
}

}  // namespace

TriangleBvh::TriangleBvh(const std::vector<TriangleCorners>& triangles) : tree_(boxes_of(triangles)) {
  triangles_.reserve(triangles.size());
  for (const int triangle : tree_.renumber())
    triangles_.push_back(triangles[static_cast<std::size_t>(triangle)]);
}

bool TriangleBvh::any(std::span<const HalfSpace> within,
                      const std::function<bool(const TriangleCorners&)>& test) const {
  return tree_.any(within,
                   [&](int triangle) { return test(triangles_[static_cast<std::size_t>(triangle)]); });
}

}  // namespace stereobench::worlds
