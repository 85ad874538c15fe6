/// Anti-aliases walls, meshes and the floor: finds the pixels that their edges run through.
///
/// A rasteriser paints a pixel by what its centre sees. Which edge runs between the centres of two
/// neighbours, and which of them it belongs to, is known from geometry and depth; so is the share of each
/// pixel on either side of it, in closed form. Each pixel of the pair then gets its neighbour's colour for
/// that share (Persson's geometric post-process anti-aliasing, done on the picture that was read back). It
/// costs what the edges' pixels cost, where several samples a pixel cost all pixels.
#pragma once

#include <vector>

#include "renderer/balls/ball_veil.h"
#include "renderer/surfaces/surface_edges.h"
#include "renderer/types.h"

namespace stereobench::renderer {

/// Two neighbouring pixels with an edge between their centres.
struct EdgeMix {
  cv::Point lower, higher;       ///< by their coordinate across the edge
  float higher_in_lower = 0.0F;  ///< share of the lower pixel that lies beyond the edge, in [0, 1]
  float lower_in_higher = 0.0F;  ///< and of the higher one
  double inverse_depth = 0.0;    ///< of the edge, 1/m
  cv::Vec3f step;                ///< of the surfaces' colours from the lower pixel to the higher one
};

class EdgeSmoother {
 public:
  EdgeSmoother(const worlds::World& world, const MeshSurfaces& meshes)
      : groups_(surface_edges(world, meshes)), has_floor_(world.has_floor) {}

  /// The pairs of pixels that edges in view divide.
  /// @param surfaces what the camera sees where there are no balls
  std::vector<EdgeMix> mixes(const CameraView& view, const RenderedImage& surfaces) const;

 private:
  std::vector<EdgeGroup> groups_;
  bool has_floor_;
};

/// Mixes the colours of pairs of pixels. Behind a ball it mixes what the ball leaves of them; identities and
/// depths stay what pixels' centres see. What is thinner than a pixel, and seen by no centre, stays unseen.
/// @param frame what the camera sees, balls included
void mix_edges(const std::vector<EdgeMix>& mixes, const BallVeil& veil, RenderedImage& frame);

/// The share of a pixel, [-1/2, 1/2] x [j - 1/2, j + 1/2], where y is lower than at + slope x.
/// @param slope in [-1, 1]
double share_low(double at, double slope, int j);

}  // namespace stereobench::renderer
