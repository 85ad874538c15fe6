/// Triangles made up by chance.
#pragma once

#include <vector>

#include "slam/math/random.h"
#include "worlds/visibility/triangle_bvh.h"

namespace stereobench::worlds {

/// A point within so much of the origin along each axis.
inline Eigen::Vector3d random_in_box(slam::RandomStream& draws, double half_m) {
  const double x = draws.uniform();
  const double y = draws.uniform();
  const double z = draws.uniform();
  return half_m * (2.0 * Eigen::Vector3d(x, y, z) - Eigen::Vector3d::Ones());
}

/// Triangles around places within a metre of the origin; one in eight has no area.
inline std::vector<TriangleCorners> random_triangles(slam::RandomStream& draws, int count, double size_m) {
  std::vector<TriangleCorners> triangles;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d middle = random_in_box(draws, 1.0);
    TriangleCorners corners;
    for (Eigen::Vector3d& corner : corners) corner = middle + random_in_box(draws, size_m);
    if (i % 8 == 7) corners[2] = 0.5 * (corners[0] + corners[1]);
    triangles.push_back(corners);
  }
  return triangles;
}

}  // namespace stereobench::worlds
