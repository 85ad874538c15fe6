/// Triangles, found by where they are.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "worlds/visibility/bvh.h"

namespace stereobench::worlds {

using TriangleCorners = std::array<Eigen::Vector3d, 3>;

/// Triangles and the tree of their boxes.
class TriangleBvh {
 public:
  /// @param triangles finite, in any axes
  explicit TriangleBvh(const std::vector<TriangleCorners>& triangles);

  /// Whether a triangle passes a test.
  /// @param within it is put to those alone whose box reaches into each of these, and to some others
  bool any(std::span<const HalfSpace> within, const std::function<bool(const TriangleCorners&)>& test) const;

 private:
  Bvh tree_;
  std::vector<TriangleCorners> triangles_;  // in the tree's order
};

}  // namespace stereobench::worlds
