/// Anti-aliases walls, meshes and the floor: mixes the pixels that their edges run through.
///
/// A rasteriser paints a pixel by what its centre sees. Which edge runs between the centres of two
/// neighbours, and which of them it belongs to, is known from geometry and depth; so is the share of each
/// pixel on either side of it, in closed form. Each pixel of the pair then gets its neighbour's colour for
/// that share (Persson's geometric post-process anti-aliasing, done on the picture that was read back). It
/// costs what the edges' pixels cost, where several samples a pixel cost all pixels.
#pragma once

#include <vector>

#include "renderer/surface_edges.h"
#include "renderer/types.h"

namespace stereobench::renderer {

class EdgeSmoother {
 public:
  EdgeSmoother(const worlds::World& world, const MeshSurfaces& meshes)
      : groups_(surface_edges(world, meshes)) {}

  /// Changes colours along the edges that the eye sees; identities and depths stay what pixels' centres see.
  /// What is thinner than a pixel, and seen by no centre, stays unseen.
  void smooth(const EyeView& view, EyeFrame& frame) const;

 private:
  std::vector<EdgeGroup> groups_;
};

/// The share of a pixel, [-1/2, 1/2] x [j - 1/2, j + 1/2], where y is lower than at + slope x.
/// @param slope in [-1, 1]
double share_low(double at, double slope, int j);

}  // namespace stereobench::renderer
