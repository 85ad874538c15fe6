/// Whose sightings are whose, decided for a frame as a whole.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "slam/association/association.h"

namespace stereobench::slam {

/// A candidate held against the prediction: what was seen minus what was expected, with its covariance.
struct Pairing {
  Eigen::Vector2d residual = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
};

/// The covariance between the residuals of two candidates (by index), of different sightings and landmarks:
/// both are off by the same error of the pose.
using Tie = std::function<Eigen::Matrix2d(std::size_t, std::size_t)>;

/// @return whether two pairs share exactly one of sighting and landmark: at most one of them is right
bool compete(const Candidate& one, const Candidate& other);

/// @return whether two landmarks within the gate compete for a sighting, two sightings for a landmark, or a
/// loose one with any other
bool is_open(std::span<const Candidate> candidates);

/// Keeps of the candidates within the gate those of the likeliest set that one pose explains: joint
/// compatibility by branch and bound (Neira and Tardos, T-RA 2001), with the likelihood of something else for
/// sightings without a pair in place of their number.
///
/// A set is compatible when the squared Mahalanobis length of all its residuals together is within the
/// chi-square quantile; what is added to a set costs one row of a Cholesky factor. Pairs without a rival are
/// taken as they are, and are the ground that the others must agree with. Where those alone contradict each
/// other, and where the search would take too many steps, the candidates stay as they are.
///
/// @param candidates all pairs of a frame; those beyond the gate are kept
/// @param pairings one for each candidate, in their order
/// @param as_other by sighting: minus twice the log likelihood of something else than its candidates; finite
/// @param probability of the quantile
/// @param cut incremented when the search took too many steps
/// @return the sightings with loose candidates, in their order, of which the likeliest set is not sure: what
/// it says of them has less than 99.9 % among all compatible sets, or what is seen fits elsewhere too
/// (fits_elsewhere), or the search did not come to its end, or it had no ground to begin with
std::vector<int> keep_joint(std::vector<Candidate>& candidates, std::span<const Pairing> pairings,
                            const Tie& tie, std::span<const double> as_other, double probability, long& cut);

}  // namespace stereobench::slam
