/// Drawing the poses of several frames together, where the landmarks that were seen are known.
#pragma once

#include <span>
#include <vector>

#include "slam/ekf/ekf_slam.h"
#include "slam/math/random.h"
#include "slam/models/belief.h"

namespace stereobench::slam {

/// How a robot came to a frame, and what it used of it.
struct BlockFrame {
  PoseBelief motion;  ///< since the frame before, in the robot's frame of that time
  std::vector<UsedSighting> used;
};

/// Draws a path from p(x_1..x_K | x_0, landmarks, sightings).
///
/// Given the landmarks, poses are a Markov chain. An iterated Kalman filter leads through the frames, which
/// is linearised at the mode of each (frame_mode): x_k- = F x_k-1 + u with covariance P_k- = F P_k-1 F' + Q,
/// and P_k after the sightings. Poses are drawn from the last one back (Carter and Kohn 1994): x_K from its
/// belief, and x_k given x_k+1 from the joint Gaussian of both,
///     [ P_k      P_k F' ]
///     [ F P_k    P_k+1- ].
/// It is conditioned on one coordinate after the other, and one that nothing is uncertain of teaches nothing:
/// the motion of a single control has rank two, and no P is inverted.
///
/// @param start the pose before the first frame, world_from_robot, known
/// @param places of the landmarks, m, in the world
/// @param repairs counts covariances that had to be repaired
/// @return the pose at each frame
std::vector<Pose> draw_path(const Pose& start, std::span<const BlockFrame> frames,
                            std::span<const Eigen::Vector2d> places, RandomStream& random, long& repairs);

}  // namespace stereobench::slam
