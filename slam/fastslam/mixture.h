/// Moments of what many particles believe.
#pragma once

#include <span>
#include <vector>

#include "slam/association/frame_reader.h"
#include "slam/fastslam/particle.h"

namespace stereobench::slam {

/// The mean and covariance of a mixture of poses: what each is unsure of and how far they lie apart.
///
/// @param posteriors one for each particle
/// @param weights normalised
PoseBelief mixed_pose(const std::vector<Posterior>& posteriors, const std::vector<double>& weights);

/// The landmarks that a set of particles reports: those of its heaviest particle, each as the mixture of what
/// all believe of it. Without an identity that is the nearest of its colour in each of the other maps.
///
/// @param weights normalised
/// @param heaviest index of a particle
/// @param reader that gave out the slots
/// @param within_m how far a neighbour may lie to count as the same landmark
std::vector<LandmarkEstimate> mixed_landmarks(const std::vector<Particle>& particles,
                                              const std::vector<double>& weights, std::size_t heaviest,
                                              const FrameReader& reader, double within_m);

/// @return the sightings that founded the landmarks of a particle's map
std::vector<int> origins_of(const Particle& particle);

}  // namespace stereobench::slam
