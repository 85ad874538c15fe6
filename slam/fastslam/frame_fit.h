/// The motion that explains a whole frame: what a particle's next pose is drawn from.
#pragma once

#include <span>
#include <vector>

#include "slam/fastslam/predictive_mixture.h"
#include "slam/models/chord.h"
#include "slam/models/linearised.h"
#include "slam/models/unscented.h"

namespace stereobench::slam {

/// A sighting beside the landmark it belongs to.
struct Match {
  LandmarkBelief landmark;
  Observation observation;
};

/// A sighting to first order in u, the error of the motion.
struct LinearMatch {
  Eigen::Vector2d expected;          ///< at the mode
  Eigen::Vector2d residual;          ///< seen less expected
  Eigen::Matrix<double, 2, 3> by_u;  ///< d expected / du
  Eigen::Matrix2d noise;             ///< of sensor and landmark
};

/// The posterior of a motion given a frame: a Gaussian around its mode.
struct FrameFit {
  Eigen::Vector3d u;            ///< the mode; motion = prior mean + L u, where L L' is the prior's covariance
  Eigen::Matrix3d of_u;         ///< covariance of u; the prior's is the identity
  ChordBelief motion;           ///< the same in chord coordinates
  double log_likelihood = 0.0;  ///< of the frame, by Laplace's approximation
  std::vector<LinearMatch> matches;  ///< in the order given
};

/// Finds the most probable motion given a frame, by Gauss-Newton steps from its mean.
///
/// Given a particle's path the pose before the motion is known and landmarks are independent. Three numbers
/// are looked for: the motion along its chord, across it, and its turn. In these the error of a coarse
/// control is Gaussian; in (x, y, heading) it lies on a curve, which a precise sensor shows.
///
/// With Unscented the sightings are then replaced by straight lines through sigma points of u and of each
/// landmark, drawn around the mode (posterior linearisation; Garcia-Fernandez et al., IEEE TSP 2015), and the
/// mode is looked for once more.
///
/// For a linear sensor the likelihood is the product of the innovations' densities.
///
/// @param from world_from_robot before the motion
/// @param motion its mean and covariance, which may be singular
/// @param matches may be none
/// @param repairs counts covariances that had to be repaired
template <class Model>
FrameFit fit_frame(const Model& model, const Pose& from, const ChordBelief& motion,
                   std::span<const Match> matches, long& repairs);

/// @return the squared Mahalanobis length of a match's innovation, predicted from the motion and all other
/// matches; chi-square with two degrees of freedom, where all is as believed
double squared_length_without(const FrameFit& fit, std::size_t match);

/// @return what each match should have been, given those before it, to first order at the mode
std::vector<ExpectedSighting> expected_in_turn(const FrameFit& fit);

}  // namespace stereobench::slam
