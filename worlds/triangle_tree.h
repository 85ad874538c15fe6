/// Triangles, found by where they are.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

namespace stereobench::worlds {

using TriangleCorners = std::array<Eigen::Vector3d, 3>;

/// One side of a plane: points with normal . point + offset >= 0, as (normal, offset).
using HalfSpace = Eigen::Vector4d;

/// A tree of boxes around triangles, each holding one half of what the box above it holds.
class TriangleTree {
 public:
  /// @param triangles finite, in any axes
  explicit TriangleTree(std::vector<TriangleCorners> triangles);

  /// Whether a triangle passes a test.
  /// @param within it is put to those alone whose box reaches into each of these, and to some others
  bool any(std::span<const HalfSpace> within, const std::function<bool(const TriangleCorners&)>& test) const;

 private:
  /// Nodes lie in the order in which they are visited.
  struct Node {
    Eigen::AlignedBox3d box;
    std::size_t behind = 0;           ///< the first node that is not below this one
    std::size_t first = 0, last = 0;  ///< triangles of a leaf
  };
  void add_node(std::size_t first, std::size_t last);

  std::vector<TriangleCorners> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace stereobench::worlds
