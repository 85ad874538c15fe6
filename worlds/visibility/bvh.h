/// Things found by the boxes around them: by where they are, and along lines.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

namespace stereobench::worlds {

/// The points origin + t direction, t > 0.
struct Ray {
  Eigen::Vector3d origin_m;
  Eigen::Vector3d direction;
};

/// One side of a plane: points with normal . point + offset >= 0, as (normal, offset).
using HalfSpace = Eigen::Vector4d;

/// A tree of boxes, each holding one half of what the box above it holds.
class Bvh {
 public:
  /// @param boxes around each thing, finite
  explicit Bvh(const std::vector<Eigen::AlignedBox3d>& boxes);

  /// Numbers things by the order in which they are asked: kept in this order they lie side by side.
  /// @return the numbers that they had
  std::vector<int> renumber();

  /// Whether a thing passes a test.
  /// @param within it is put to those alone whose box reaches into each of these, and to some others
  bool any(std::span<const HalfSpace> within, const std::function<bool(int)>& test) const;

  /// What a line enters first.
  struct Met {
    int thing = -1;  ///< its number: the index of its box, or what renumber() made of it; -1: none
    double at = 0.0;
  };
  /// @param from,before the stretch of the line that is looked at
  /// @param enter where the line enters a thing, +inf where it passes by; asked of those alone whose boxes it
  ///   meets, and of some others
  Met first(const Ray& line, double from, double before, const std::function<double(int)>& enter) const;

 private:
  /// Nodes lie in the order in which they are visited.
  struct Node {
    Eigen::AlignedBox3d box;
    std::size_t behind = 0;           ///< the first node that is not below this one
    std::size_t first = 0, last = 0;  ///< things of a leaf
  };
  /// A thing while the tree grows.
  struct Boxed {
    Eigen::AlignedBox3d box;
    int thing;
  };
  void add_node(std::vector<Boxed>& things, std::size_t first, std::size_t last);
  template <class Reach, class Visit>
  bool visit_until(const Reach& reaches, const Visit& visit) const;

  std::vector<int> things_;
  std::vector<Node> nodes_;
};

}  // namespace stereobench::worlds
