/// All landmarks of a frame at once, each as it should look from the predicted pose.
#pragma once

#include <span>

#include <Eigen/QR>

#include "slam/fastslam/particle.h"

namespace stereobench::slam {

/// What a landmark should look like, beside what was seen.
struct Expectation {
  PredictedMeasurement predicted;
  Eigen::Vector2d residual = Eigen::Vector2d::Zero();  ///< wrapped
};

/// A square root of a pose's covariance, P = L L', which may be singular.
class PoseRoot {
 public:
  explicit PoseRoot(const Eigen::Matrix3d& root);

  const Eigen::Matrix3d& matrix() const { return root_; }

  /// @param cross covariance of the pose and a sighting
  /// @return W with L W = cross: the covariance of u ~ N(0, I) with the sighting, where pose = mean + L u
  Eigen::Matrix<double, 3, 2> divide(const Eigen::Matrix<double, 3, 2>& cross) const;

 private:
  Eigen::Matrix3d root_;
  Eigen::Vector3d by_sd_;  ///< rows are measured in standard deviations: the rank does not depend on units
  Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix3d> in_sd_;
};

/// The Kalman update by a whole frame, whose moments are all of the prediction: sigma points, or Jacobians,
/// are not drawn anew for the next landmark.
///
/// The sightings depend on one pose and otherwise on nothing in common: S_ij = W_i' W_j for i /= j, where
/// pose = predicted + L u, P = L L', and W_i is the covariance of u with sighting i. Published code puts the
/// landmarks of a frame on the same sigma columns (docs/errata.md), which correlates what is not. In terms of
/// u the whole stack is three numbers and a 3x3 matrix, at a cost linear in the landmarks, and a singular P
/// is nothing special.
///
/// @param predicted before the frame is used
/// @param frame at least one
/// @param repairs counts covariances that had to be repaired
Posterior correct_at_once(const PoseBelief& predicted, std::span<const Expectation> frame, long& repairs);

}  // namespace stereobench::slam
