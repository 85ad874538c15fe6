#include "renderer/box_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace stereobench::renderer {
namespace {

constexpr std::size_t kLeaf = 4;   // things; fewer are asked as fast as further boxes
constexpr double kMargin = 1e-12;  // relative: what lies in a face of its box is met in spite of rounding

/// The box with room for rounding.
Eigen::AlignedBox3d padded(const Eigen::AlignedBox3d& box) {
  const double size = std::max({1.0, box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff()});
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(kMargin * size);
  return {box.min() - margin, box.max() + margin};
}

/// A line, ready to be held against boxes.
struct Slabs {
  explicit Slabs(const Sightline& line) : origin(line.origin_m), inverse(line.direction.cwiseInverse()) {}

  /// Whether the line is in the box somewhere between two places.
  bool meet(const Eigen::AlignedBox3d& box, double from, double before) const {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      double enters = (box.min()[axis] - origin[axis]) * inverse[axis];
      double leaves = (box.max()[axis] - origin[axis]) * inverse[axis];
      if (enters > leaves) std::swap(enters, leaves);
      if (enters > from) from = enters;  // what is no number bounds nothing
      if (leaves < before) before = leaves;
    }
    return from <= before;
  }

  Eigen::Vector3d origin, inverse;
};

}  // namespace

BoxTree::BoxTree(std::vector<Eigen::AlignedBox3d> boxes) : things_(boxes.size()) {
  std::transform(boxes.begin(), boxes.end(), boxes.begin(), padded);
  std::iota(things_.begin(), things_.end(), 0);
  if (!boxes.empty()) add_node(boxes, 0, boxes.size());
}

void BoxTree::add_node(const std::vector<Eigen::AlignedBox3d>& boxes, std::size_t first, std::size_t last) {
  const auto box_of = [&](int thing) -> const Eigen::AlignedBox3d& {
    return boxes[static_cast<std::size_t>(thing)];
  };
  const auto at = [&](std::size_t i) { return things_.begin() + static_cast<std::ptrdiff_t>(i); };
  const std::size_t own = nodes_.size();
  Node node;
  Eigen::AlignedBox3d middles;
  std::for_each(at(first), at(last), [&](int thing) {
    node.box.extend(box_of(thing));
    middles.extend(box_of(thing).center());
  });
  nodes_.push_back(node);
  if (last - first <= kLeaf) {
    nodes_[own].first = first;
    nodes_[own].last = last;
  } else {
    Eigen::Index axis = 0;
    middles.sizes().maxCoeff(&axis);
    const std::size_t half = first + (last - first) / 2;
    std::nth_element(at(first), at(half), at(last),
                     [&](int a, int b) { return box_of(a).center()[axis] < box_of(b).center()[axis]; });
    add_node(boxes, first, half);
    add_node(boxes, half, last);
  }
  nodes_[own].behind = nodes_.size();
}

BoxTree::Met BoxTree::first(const Sightline& line, double from, double before,
                            const std::function<double(int)>& enter) const {
  const Slabs slabs(line);
  Met met{-1, before};
  for (std::size_t i = 0; i < nodes_.size();) {
    const Node& node = nodes_[i];
    if (!slabs.meet(node.box, from, met.at)) {
      i = node.behind;
      continue;
    }
    for (std::size_t k = node.first; k < node.last; ++k) {
      const double there = enter(things_[k]);
      if (there >= from && there < met.at) met = {things_[k], there};
    }
    ++i;
  }
  return met;
}

}  // namespace stereobench::renderer
