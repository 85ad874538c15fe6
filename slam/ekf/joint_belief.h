/// One Gaussian of the pose and all landmarks, and what motion and sightings do to it.
#pragma once

#include <vector>

#include "slam/association/joint_compatibility.h"
#include "slam/association/sighting.h"
#include "slam/ekf/joint_covariance.h"
#include "slam/math/gaussian.h"
#include "slam/models/belief.h"

namespace stereobench::slam {

/// Where the robot and all landmarks are believed to be, with everything that ties them together.
struct JointBelief {
  Pose pose;
  std::vector<Eigen::Vector2d> landmarks;  ///< m, in the world
  JointCovariance covariance;
};

/// A sighting held against what its landmark should look like.
struct JointInnovation {
  Eigen::Matrix<double, 2, 5> slope;  ///< H: of (range, bearing) by (pose, landmark)
  Eigen::Matrix<double, 2, 5> near;   ///< H P: covariance with (pose, landmark)
  Eigen::Matrix2d covariance;         ///< S = H P H' + R
  Factor2 factor;                     ///< of S
  Eigen::Vector2d residual;           ///< wrapped

  double squared_length() const { return factor.squared_length(residual); }
};

/// What was expected of a sighting.
///
/// @param squared_length at which it is weighed: its own, or the gate's where it is refused
ExpectedSighting expectation(const JointInnovation& seen, const Observation& observation,
                             double squared_length);

/// Puts a motion behind the pose: O(n), for a landmark feels it through its covariance with the pose alone.
///
/// @param motion in the robot's frame before it
void follow(JointBelief& belief, const PoseBelief& motion);

/// Looks for a landmark where it should be.
///
/// @param repairs counts covariances that had to be repaired
JointInnovation innovation(const JointBelief& belief, int landmark, const Observation& observation,
                           long& repairs);

/// The same, linearised elsewhere.
///
/// @param at a better guess of what the belief will become
JointInnovation innovation(const JointBelief& belief, const JointBelief& at, int landmark,
                           const Observation& observation, long& repairs);

/// The same, linearised at the place that the sighting points at: what it says of a shift of the pose does
/// not bend, however near the landmark.
JointInnovation innovation_at_sighting(const JointBelief& belief, int landmark,
                                       const Observation& observation, long& repairs);

/// The Kalman update in gain form, O(n^2): K = P H' S^-1, so a singular P is nothing special.
void correct(JointBelief& belief, int landmark, const JointInnovation& seen, long& repairs);

/// How far a landmark is from another, which would be nothing if they were one.
Pairing apart(const JointBelief& belief, int one, int other);

/// Learns that two landmarks are at one place: the Kalman update.
void merge(JointBelief& belief, int one, int other, long& repairs);

/// Takes a landmark for what is seen now: one that is new, or one whose place turned out to be wrong.
///
/// @param landmark index of a landmark, or one more than the last
/// @param found where it is seen from the pose's mean, with the sensor's uncertainty
/// @param repairs counts covariances that had to be repaired
void place(JointBelief& belief, int landmark, const LandmarkBelief& found, long& repairs);

}  // namespace stereobench::slam
