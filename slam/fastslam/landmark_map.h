/// A particle's map: landmarks in order of discovery, shared between particles until one of them changes.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "slam/association/landmark.h"

namespace stereobench::slam {

/// Landmarks by index, in a tree of eight branches a node whose nodes several maps can own together.
///
/// A particle that is drawn twice becomes two whose maps differ only in what each sees from then on. Their
/// maps share all nodes, and a node is copied when one of its owners is about to change it and it has others
/// (Montemerlo's tree, 2003, with wider nodes). A step then costs what is seen in it, and memory what has
/// changed, however large the map is. A robot finds landmarks along its way, so that neighbours in the tree
/// are neighbours in the world, and the bounds of its nodes serve the search for landmarks near a place.
///
/// A copy is a value like any other and shares nothing; share() is for descendants within one filter. Owners
/// must stay on one thread.
class LandmarkMap {
 public:
  LandmarkMap() = default;
  LandmarkMap(const LandmarkMap& other);
  LandmarkMap(LandmarkMap&& other) noexcept { swap(other); }
  LandmarkMap& operator=(LandmarkMap other) noexcept;
  ~LandmarkMap();

  /// @return a map with the same landmarks, at the same cost for any number of them
  LandmarkMap share() const;

  std::size_t size() const { return size_; }

  /// @param index below size()
  const Landmark& operator[](std::size_t index) const;

  /// Changes one landmark of this map and of no other.
  /// @param index below size()
  void replace(std::size_t index, const Landmark& landmark);

  void push_back(const Landmark& landmark);

  /// Visits landmarks in order of discovery, skipping groups.
  /// @param may_matter (const LandmarkBounds&) -> bool: whether any landmark within such bounds matters
  /// @param visit (std::size_t index, const Landmark&)
  template <class MayMatter, class Visit>
  void visit(const MayMatter& may_matter, const Visit& visit) const {
    if (root_ && may_matter(bounds_)) descend(*root_, height_, 0, may_matter, visit);
  }

 private:
  static constexpr int kWidthBits = 3;
  static constexpr std::size_t kWidth = 1 << kWidthBits;
  struct Node {
    int owners = 1;
  };
  struct Leaf;
  struct Branch;

  static Node* copy_of(const Node& node, int height, bool deep);
  static void release(Node* node, int height);
  static void make_own(Node*& node, int height);
  static bool put(Node*& node, int height, std::size_t index, const Landmark& landmark,
                  LandmarkBounds& bounds);
  static std::size_t capacity(int height);
  static std::size_t place(std::size_t index, int height);  ///< among the children of a node on its way
  void swap(LandmarkMap& other) noexcept;

  template <class MayMatter, class Visit>
  void descend(const Node& node, int height, std::size_t first, const MayMatter& may_matter,
               const Visit& visit) const;

  Node* root_ = nullptr;
  int height_ = 0;  ///< of the root; 0 = a leaf
  std::size_t size_ = 0;
  LandmarkBounds bounds_;  ///< of the root
};

struct LandmarkMap::Leaf : Node {
  std::array<Landmark, kWidth> landmarks;
  std::size_t count = 0;
};

struct LandmarkMap::Branch : Node {
  std::array<Node*, kWidth> children = {};         ///< from the first on; null beyond the last
  std::array<LandmarkBounds, kWidth> bounds = {};  ///< of the children
};

template <class MayMatter, class Visit>
void LandmarkMap::descend(const Node& node, int height, std::size_t first, const MayMatter& may_matter,
                          const Visit& visit) const {
  if (height == 0) {
    const Leaf& leaf = static_cast<const Leaf&>(node);
    for (std::size_t i = 0; i < leaf.count; ++i) visit(first + i, leaf.landmarks[i]);
    return;
  }
  const Branch& branch = static_cast<const Branch&>(node);
  for (std::size_t i = 0; i < kWidth && branch.children[i]; ++i) {
    if (may_matter(branch.bounds[i]))
      descend(*branch.children[i], height - 1, first + i * capacity(height - 1), may_matter, visit);
  }
}

}  // namespace stereobench::slam
