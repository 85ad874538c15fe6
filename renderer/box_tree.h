/// Things found by the boxes around them, along lines.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include <Eigen/Geometry>

#include "renderer/sightline.h"

namespace stereobench::renderer {

/// A tree of boxes, each holding one half of what the box above it holds.
class BoxTree {
 public:
  /// @param boxes around each thing, finite
  explicit BoxTree(std::vector<Eigen::AlignedBox3d> boxes);

  /// What a line enters first.
  struct Met {
    int thing = -1;  ///< index of its box; none
    double at = 0.0;
  };
  /// @param from,before the stretch of the line that is looked at
  /// @param enter where the line enters a thing, +inf where it passes by; asked of those alone whose boxes it
  ///   meets, and of some others
  Met first(const Sightline& line, double from, double before, const std::function<double(int)>& enter) const;

 private:
  /// Nodes lie in the order in which they are visited.
  struct Node {
    Eigen::AlignedBox3d box;
    std::size_t behind = 0;           ///< the first node that is not below this one
    std::size_t first = 0, last = 0;  ///< things of a leaf
  };
  void add_node(const std::vector<Eigen::AlignedBox3d>& boxes, std::size_t first, std::size_t last);

  std::vector<int> things_;
  std::vector<Node> nodes_;
};

}  // namespace stereobench::renderer
