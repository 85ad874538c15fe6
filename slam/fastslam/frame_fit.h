/// The pose that explains a whole frame: all its sightings at once, where one after the other is too coarse.
#pragma once

#include <span>

#include "slam/fastslam/particle.h"

namespace stereobench::slam {

/// A sighting beside the landmark it belongs to.
struct Match {
  LandmarkBelief landmark;
  Observation observation;
};

/// A pose fitted to a whole frame, and how well it fits.
struct FrameFit {
  Posterior posterior;
  double prior_cost =
      0.0;  ///< squared Mahalanobis distance from the prediction; chi-square with <= 3 degrees
  double sighting_cost = 0.0;  ///< of the sightings from the fitted pose; chi-square with 2 degrees each
};

/// Finds the most probable pose given a frame, by Gauss-Newton from the predicted pose over all matches at
/// once.
///
/// Corrections one after the other take each landmark's moments where the last one left the pose. With a
/// sensor of a millimetre and odometry of centimetres the bend of the range over the pose's uncertainty is
/// larger than the noise, and a right sighting looks wrong. Here everything is linearised at the solution.
/// The pose is written as predicted + L u with P = L L' and u ~ N(0, I), so a singular P is nothing special.
/// The likelihood is Laplace's approximation; for a linear sensor it is the product of the innovations'
/// densities.
///
/// @param predicted before the frame is used
/// @param matches at least one
/// @param repairs counts covariances that had to be repaired
FrameFit fit_frame(const PoseBelief& predicted, std::span<const Match> matches, long& repairs);

}  // namespace stereobench::slam
