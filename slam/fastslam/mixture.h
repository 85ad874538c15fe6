/// Moments of what many particles believe.
#pragma once

#include <span>
#include <vector>

#include "slam/fastslam/particle.h"

namespace stereobench::slam {

/// The mean and covariance of a mixture of poses: what each is unsure of and how far they lie apart.
///
/// @param posteriors one for each particle
/// @param weights normalised
PoseBelief mixed_pose(const std::vector<Posterior>& posteriors, const std::vector<double>& weights);

/// The same of a landmark that all particles know by its slot.
LandmarkBelief mixed_landmark(const std::vector<Particle>& particles, const std::vector<double>& weights,
                              std::size_t slot);

/// The same of a landmark of one particle's map and its nearest neighbours of that colour in the others'
/// maps.
///
/// @param own the landmark in the particle that is reported
/// @param within_m how far a neighbour may lie to count as the same landmark
LandmarkBelief mixed_landmark_near(const std::vector<Particle>& particles, const std::vector<double>& weights,
                                   const Landmark& own, double within_m);

}  // namespace stereobench::slam
