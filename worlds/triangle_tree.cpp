#include "worlds/triangle_tree.h"

#include <algorithm>

namespace stereobench::worlds {
namespace {

constexpr std::size_t kLeaf = 4;  // triangles; fewer are tested as fast as further boxes

Eigen::Vector3d thrice_the_middle(const TriangleCorners& corners) {
  return corners[0] + corners[1] + corners[2];
}

/// Whether no point of the box is in the half-space; not even the farthest corner on its side.
bool is_outside(const Eigen::AlignedBox3d& box, const HalfSpace& half) {
  const Eigen::Vector3d normal = half.head<3>();
  return normal.cwiseProduct(box.min()).cwiseMax(normal.cwiseProduct(box.max())).sum() + half.w() < 0.0;
}

}  // namespace

TriangleTree::TriangleTree(std::vector<TriangleCorners> triangles) : triangles_(std::move(triangles)) {
  if (!triangles_.empty()) add_node(0, triangles_.size());
}

void TriangleTree::add_node(std::size_t first, std::size_t last) {
  const std::size_t own = nodes_.size();
  Node node;
  Eigen::AlignedBox3d middles;
  for (std::size_t i = first; i < last; ++i) {
    for (const Eigen::Vector3d& corner : triangles_[i]) node.box.extend(corner);
    middles.extend(thrice_the_middle(triangles_[i]));
  }
  nodes_.push_back(node);
  if (last - first <= kLeaf) {
    nodes_[own].first = first;
    nodes_[own].last = last;
  } else {
    Eigen::Index axis = 0;
    middles.sizes().maxCoeff(&axis);
    const auto begin = triangles_.begin();
    const std::size_t half = first + (last - first) / 2;
    const auto at = [&](std::size_t i) { return begin + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(first), at(half), at(last), [&](const auto& a, const auto& b) {
      return thrice_the_middle(a)[axis] < thrice_the_middle(b)[axis];
    });
    add_node(first, half);
    add_node(half, last);
  }
  nodes_[own].behind = nodes_.size();
}

bool TriangleTree::any(std::span<const HalfSpace> within,
                       const std::function<bool(const TriangleCorners&)>& test) const {
  for (std::size_t i = 0; i < nodes_.size();) {
    const Node& node = nodes_[i];
    if (std::ranges::any_of(within, [&](const HalfSpace& half) { return is_outside(node.box, half); })) {
      i = node.behind;
      continue;
    }
    for (std::size_t k = node.first; k < node.last; ++k)
      if (test(triangles_[k])) return true;
    ++i;
  }
  return false;
}

}  // namespace stereobench::worlds
