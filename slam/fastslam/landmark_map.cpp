#include "slam/fastslam/landmark_map.h"

#include <algorithm>

namespace stereobench::slam {
namespace {

void extend(LandmarkBounds& bounds, const LandmarkBounds& by) {
  bounds.places_m.extend(by.places_m);
  bounds.largest_variance_m2 = std::max(bounds.largest_variance_m2, by.largest_variance_m2);
}

bool equal(const LandmarkBounds& a, const LandmarkBounds& b) {
  return a.places_m.min() == b.places_m.min() && a.places_m.max() == b.places_m.max() &&
         a.largest_variance_m2 == b.largest_variance_m2;
}

LandmarkBounds bounds_of(const Landmark& landmark) {
  const LandmarkBelief& belief = landmark.belief;
  return {{belief.mean, belief.mean}, belief.covariance.trace()};
}

}  // namespace

LandmarkMap::LandmarkMap(const LandmarkMap& other)
    : root_(other.root_ ? copy_of(*other.root_, other.height_, true) : nullptr),
      height_(other.height_),
      size_(other.size_),
      bounds_(other.bounds_) {}

LandmarkMap& LandmarkMap::operator=(LandmarkMap other) noexcept {
  swap(other);
  return *this;
}

LandmarkMap::~LandmarkMap() {
  release(root_, height_);
}

LandmarkMap LandmarkMap::share() const {
  LandmarkMap map;
  map.root_ = root_;
  map.height_ = height_;
  map.size_ = size_;
  map.bounds_ = bounds_;
  if (root_) ++root_->owners;
  return map;
}

const Landmark& LandmarkMap::operator[](std::size_t index) const {
  const Node* node = root_;
  for (int height = height_; height > 0; --height) {
    node = static_cast<const Branch*>(node)->children[place(index, height)];
  }
  return static_cast<const Leaf*>(node)->landmarks[place(index, 0)];
}

void LandmarkMap::replace(std::size_t index, const Landmark& landmark) {
  put(root_, height_, index, landmark, bounds_);
}

void LandmarkMap::push_back(const Landmark& landmark) {
  if (root_ && size_ == capacity(height_)) {  // a root above the root
    auto* above = new Branch;
    above->children[0] = root_;
    above->bounds[0] = bounds_;
    root_ = above;
    ++height_;
  }
  put(root_, height_, size_, landmark, bounds_);
  ++size_;
}

LandmarkMap::Node* LandmarkMap::copy_of(const Node& node, int height, bool deep) {
  if (height == 0) {
    auto* leaf = new Leaf(static_cast<const Leaf&>(node));
    leaf->owners = 1;
    return leaf;
  }
  auto* branch = new Branch(static_cast<const Branch&>(node));
  branch->owners = 1;
  for (Node*& child : branch->children) {
    if (!child) break;
    if (deep) {
      child = copy_of(*child, height - 1, true);
    } else {
      ++child->owners;
    }
  }
  return branch;
}

void LandmarkMap::release(Node* node, int height) {
  if (!node || --node->owners > 0) return;
  if (height == 0) {
    delete static_cast<Leaf*>(node);
    return;
  }
  auto* branch = static_cast<Branch*>(node);
  for (Node* child : branch->children) release(child, height - 1);
  delete branch;
}

/// Makes a node exist and belong to one owner alone.
void LandmarkMap::make_own(Node*& node, int height) {
  if (!node) {
    node = height == 0 ? static_cast<Node*>(new Leaf) : new Branch;
  } else if (node->owners > 1) {
    Node* own = copy_of(*node, height, false);
    release(node, height);
    node = own;
  }
}

/// Writes a landmark below a node, behind the last one or over another.
/// @param index in the whole map
/// @param bounds of the node; receives what they are after that
/// @return whether the bounds have changed
bool LandmarkMap::put(Node*& node, int height, std::size_t index, const Landmark& landmark,
                      LandmarkBounds& bounds) {
  make_own(node, height);
  LandmarkBounds after;
  if (height == 0) {
    auto* leaf = static_cast<Leaf*>(node);
    leaf->landmarks[place(index, 0)] = landmark;
    leaf->count = std::max(leaf->count, place(index, 0) + 1);
    for (std::size_t i = 0; i < leaf->count; ++i) extend(after, bounds_of(leaf->landmarks[i]));
  } else {
    auto* branch = static_cast<Branch*>(node);
    const std::size_t child = place(index, height);
    if (!put(branch->children[child], height - 1, index, landmark, branch->bounds[child])) return false;
    for (const LandmarkBounds& part : branch->bounds) extend(after, part);
  }
  const bool changed = !equal(after, bounds);
  bounds = after;
  return changed;
}

std::size_t LandmarkMap::capacity(int height) {
  return kWidth << (kWidthBits * height);
}

std::size_t LandmarkMap::place(std::size_t index, int height) {
  return (index >> (kWidthBits * height)) % kWidth;
}

void LandmarkMap::swap(LandmarkMap& other) noexcept {
  std::swap(root_, other.root_);
  std::swap(height_, other.height_);
  std::swap(size_, other.size_);
  std::swap(bounds_, other.bounds_);
}

}  // namespace stereobench::slam
