/// Drawing the places of landmarks that one Gaussian ties together.
#pragma once

#include <vector>

#include "slam/ekf/joint_belief.h"
#include "slam/math/random.h"

namespace stereobench::slam {

/// Draws all landmarks of a belief together, the pose left out.
///
/// The root is taken of the correlations, so that metres and millimetres go together, and lets what is
/// semidefinite up to rounding pass.
///
/// @param repairs counts covariances that had to be repaired
/// @return their places, m, in the world
std::vector<Eigen::Vector2d> draw_landmarks(const JointBelief& belief, RandomStream& random, long& repairs);

}  // namespace stereobench::slam
