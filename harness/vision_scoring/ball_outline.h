/// Where balls are in the images of a pair, and how much of them can be seen, from the renderer's truth.
#pragma once

#include <vector>

#include "renderer/types.h"
#include "slam/types.h"
#include "vision/stereo/sphere.h"
#include "vision/types.h"
#include "worlds/types.h"

namespace stereobench::harness {

/// The truth behind one stereo pair.
struct VisionTruth {
  const worlds::World& world;
  const vision::StereoRig& rig;
  slam::Pose world_from_robot;
  const renderer::StereoFrame& frame;
};

/// A ball as both cameras would see it with nothing in its way, and how much of it they do see.
struct BallInPair {
  int ball = 0;  ///< index into World::balls
  Eigen::Vector3d ball_in_robot = Eigen::Vector3d::Zero();
  vision::OutlineEllipse left;  ///< in a picture without distortion
  vision::OutlineEllipse right;
  double left_fraction = 0.0;  ///< pixels of this ball over the area of its whole outline; about 1 at most
  double right_fraction = 0.0;
  bool inside_both = false;  ///< the whole outline lies within both images
};

/// Whether both cameras see a ball all but whole: inside of their images, at least 95 % of it not hidden.
bool is_whole(const BallInPair& ball);

/// The outlines of the balls in a pair.
/// @return one for each ball that is wholly ahead of both cameras, also outside the images, in order of the
/// balls
std::vector<BallInPair> ball_outlines(const VisionTruth& truth);

/// Whether a pixel lies within an outline.
bool contains(const vision::OutlineEllipse& outline, const Eigen::Vector2d& pixel_px);

}  // namespace stereobench::harness
