#include "renderer/meshes/duplicate_back_faces.h"

#include <algorithm>
#include <array>

namespace stereobench::renderer {
namespace {

using Place = std::array<double, 3>;
using Corners = std::array<Place, 3>;

/// The corners from the first in order of place on, in the order in which they run around the face.
Corners corners_of(const Triangle& triangle) {
  Corners corners;
  for (std::size_t i = 0; i < 3; ++i)
    corners[i] = {triangle.corners[i].x(), triangle.corners[i].y(), triangle.corners[i].z()};
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

}  // namespace

std::vector<bool> have_opposites(const std::vector<Triangle>& triangles) {
  std::vector<Corners> all;
  for (const Triangle& triangle : triangles) all.push_back(corners_of(triangle));
  std::vector<Corners> sorted = all;
  std::sort(sorted.begin(), sorted.end());
  std::vector<bool> have;
  for (const Corners& corners : all)
    have.push_back(
        std::binary_search(sorted.begin(), sorted.end(), Corners{corners[0], corners[2], corners[1]}));
  return have;
}

}  // namespace stereobench::renderer
