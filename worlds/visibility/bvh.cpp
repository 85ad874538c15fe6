#include "worlds/visibility/bvh.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace stereobench::worlds {
namespace {

constexpr std::size_t kLeaf = 4;   // things; fewer are asked as fast as further boxes
constexpr double kMargin = 1e-12;  // relative: what lies in a face of its box is met in spite of rounding

/// The box with room for rounding.
Eigen::AlignedBox3d padded(const Eigen::AlignedBox3d& box) {
  const double size = std::max({1.0, box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff()});
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(kMargin * size);
  return {box.min() - margin, box.max() + margin};
}

/// Whether no point of the box is in the half-space; not even the farthest corner on its side.
bool is_outside(const Eigen::AlignedBox3d& box, const HalfSpace& half) {
  const Eigen::Vector3d normal = half.head<3>();
  return normal.cwiseProduct(box.min()).cwiseMax(normal.cwiseProduct(box.max())).sum() + half.w() < 0.0;
}

/// A line, ready to be held against boxes.
struct Slabs {
  explicit Slabs(const Ray& line) : origin(line.origin_m), inverse(line.direction.cwiseInverse()) {}

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

Bvh::Bvh(const std::vector<Eigen::AlignedBox3d>& boxes) {
  std::vector<Boxed> things;
  things.reserve(boxes.size());
  for (const Eigen::AlignedBox3d& box : boxes)
    things.push_back({padded(box), static_cast<int>(things.size())});
  if (!things.empty()) add_node(things, 0, things.size());
  things_.reserve(things.size());
  for (const Boxed& boxed : things) things_.push_back(boxed.thing);
}

void Bvh::add_node(std::vector<Boxed>& things, std::size_t first, std::size_t last) {
  const auto at = [&](std::size_t i) { return things.begin() + static_cast<std::ptrdiff_t>(i); };
  const std::size_t own = nodes_.size();
  Node node;
  Eigen::AlignedBox3d middles;
  std::for_each(at(first), at(last), [&](const Boxed& boxed) {
    node.box.extend(boxed.box);
    middles.extend(boxed.box.center());
  });
  nodes_.push_back(node);
  if (last - first <= kLeaf) {
    nodes_[own].first = first;
    nodes_[own].last = last;
  } else {
    Eigen::Index axis = 0;
    middles.sizes().maxCoeff(&axis);
    const std::size_t half = first + (last - first) / 2;
    std::nth_element(at(first), at(half), at(last), [&](const Boxed& a, const Boxed& b) {
      return a.box.center()[axis] < b.box.center()[axis];
    });
    add_node(things, first, half);
    add_node(things, half, last);
  }
  nodes_[own].behind = nodes_.size();
}

std::vector<int> Bvh::renumber() {
  std::vector<int> before = things_;
  std::iota(things_.begin(), things_.end(), 0);
  return before;
}

/// Visits the things of leaves that are reached, until a visit is the last one.
/// @return whether one was
template <class Reach, class Visit>
bool Bvh::visit_until(const Reach& reaches, const Visit& visit) const {
  for (std::size_t i = 0; i < nodes_.size();) {
    const Node& node = nodes_[i];
    if (!reaches(node.box)) {
      i = node.behind;
      continue;
    }
    for (std::size_t k = node.first; k < node.last; ++k)
      if (visit(things_[k])) return true;
    ++i;
  }
  return false;
}

bool Bvh::any(std::span<const HalfSpace> within, const std::function<bool(int)>& test) const {
  const auto reaches = [&](const Eigen::AlignedBox3d& box) {
    return std::ranges::none_of(within, [&](const HalfSpace& half) { return is_outside(box, half); });
  };
  return visit_until(reaches, test);
}

Bvh::Met Bvh::first(const Ray& line, double from, double before,
                    const std::function<double(int)>& enter) const {
  const Slabs slabs(line);
  Met met{-1, before};
  const auto reaches = [&](const Eigen::AlignedBox3d& box) { return slabs.meet(box, from, met.at); };
  visit_until(reaches, [&](int thing) {
    const double there = enter(thing);
    if (there >= from && there < met.at) met = {thing, there};
    return false;
  });
  return met;
}

}  // namespace stereobench::worlds
