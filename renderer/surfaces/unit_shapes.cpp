#include "renderer/surfaces/unit_shapes.h"

#include <cmath>
#include <stdexcept>

#include <Eigen/Geometry>

namespace stereobench::renderer {
namespace {

using Eigen::Vector3d;

const Vector3d kWhite = Vector3d::Ones();

Triangle flat(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d normal = (b - a).cross(c - a).normalized();
  return {{a, b, c}, {normal, normal, normal}, kWhite};
}

std::vector<Triangle> unit_box() {
  std::vector<Triangle> triangles;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-0.5, 0.5}) {
      const Vector3d middle = side * Vector3d::Unit(axis) + Vector3d(0.0, 0.0, 0.5);
      const Vector3d along = 0.5 * Vector3d::Unit((axis + 1) % 3);
      const Vector3d up = std::copysign(0.5, side) * Vector3d::Unit((axis + 2) % 3);
      triangles.push_back(flat(middle - along - up, middle + along - up, middle + along + up));
      triangles.push_back(flat(middle - along - up, middle + along + up, middle - along + up));
    }
  }
  return triangles;
}

/// A part of the unit sphere, cut into four until it is flat enough.
void cut(const Vector3d& a, const Vector3d& b, const Vector3d& c, int times, std::vector<Triangle>& faces) {
  if (times == 0) {
    const auto place = [](const Vector3d& direction) {
      return Vector3d(0.5 * direction + Vector3d(0.0, 0.0, 0.5));
    };
    faces.push_back({{place(a), place(b), place(c)}, {a, b, c}, kWhite});
    return;
  }
  const Vector3d ab = (a + b).normalized(), bc = (b + c).normalized(), ca = (c + a).normalized();
  cut(a, ab, ca, times - 1, faces);
  cut(ab, b, bc, times - 1, faces);
  cut(ca, bc, c, times - 1, faces);
  cut(ab, bc, ca, times - 1, faces);
}

/// An icosahedron, each face in sixteen.
std::vector<Triangle> unit_ball() {
  const double golden = 0.5 * (1.0 + std::sqrt(5.0));
  std::vector<Vector3d> corners;
  for (int axis = 0; axis < 3; ++axis)
    for (const double one : {-1.0, 1.0})
      for (const double wide : {-golden, golden})
        corners.push_back((one * Vector3d::Unit(axis) + wide * Vector3d::Unit((axis + 1) % 3)).normalized());
  const double side = 2.0 / std::sqrt(golden * golden + 1.0);
  const auto is_side = [&](std::size_t i, std::size_t k) {
    return std::abs((corners[i] - corners[k]).norm() - side) < 1e-9;
  };
  std::vector<Triangle> faces;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t k = i + 1; k < corners.size(); ++k) {
      for (std::size_t m = k + 1; m < corners.size(); ++m) {
        if (!is_side(i, k) || !is_side(k, m) || !is_side(i, m)) continue;
        const bool outward = corners[i].dot(corners[k].cross(corners[m])) > 0.0;
        cut(corners[i], corners[outward ? k : m], corners[outward ? m : k], 2, faces);
      }
    }
  }
  return faces;
}

}  // namespace

std::vector<Triangle> unit_shape(worlds::MeshShape shape) {
  switch (shape) {
    case worlds::MeshShape::kBox:
      return unit_box();
    case worlds::MeshShape::kBall:
      return unit_ball();
    case worlds::MeshShape::kFile:
      break;
  }
  throw std::invalid_argument("unit_shape: a file has a shape of its own");
}

}  // namespace stereobench::renderer
