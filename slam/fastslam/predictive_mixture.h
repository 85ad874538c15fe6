/// What a set of particles together expects of a frame.
#pragma once

#include <span>
#include <vector>

#include "slam/association/sighting.h"
#include "slam/update_report.h"

namespace stereobench::slam {

/// Holds each sighting against the mixture of what the particles expected, taken as the Gaussian of the same
/// mean and covariance.
///
/// A particle's share in what is expected of a sighting is its weight before the frame, times what the
/// sightings before it were worth to it. Which are before it is said by the heaviest particle: the age of the
/// landmarks, as in PoseCorrection. Where identities are known all particles agree on that; where only
/// colours are, each expects its own landmark, in an order of its own that hardly ever is another one. A
/// sighting that particles of more than half of the weight take for a new landmark was not expected.
///
/// @param targets particle by particle, as decided in the end
/// @param expected particle by particle
/// @param log_weights before the frame, normalised
/// @return in the order in which the sightings were used
std::vector<NormalisedInnovation> normalised_innovations(std::span<const Sighting> frame,
                                                         std::span<const Target> targets,
                                                         std::span<const ExpectedSighting> expected,
                                                         std::span<const double> log_weights);

}  // namespace stereobench::slam
