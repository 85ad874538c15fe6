/// What explains a frame best: the iterated Kalman update, before anything is linearised for good.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "slam/ekf/joint_belief.h"
#include "slam/models/chord.h"

namespace stereobench::slam {

/// A sighting and the landmark that it is given to.
struct SeenLandmark {
  int landmark = 0;
  Observation observation;
};

/// Where a frame is linearised: at the likeliest pose before the motion, motion and landmarks, given the
/// belief before and the sightings after.
struct FrameMode {
  Pose from;                               ///< before the motion
  Eigen::Vector3d chord;                   ///< the motion
  std::vector<Eigen::Vector2d> landmarks;  ///< by sighting

  /// By sighting: squared Mahalanobis length of its innovation, predicted from all that is known but itself.
  /// Chi-square distributed with two degrees of freedom, where all is as believed.
  std::vector<double> squared_lengths;

  /// By how much the frame's cost after the first step differs from what the slopes at the prior's mean
  /// foresee: a difference of squared Mahalanobis lengths, 0 where nothing bends.
  double bend = 0.0;
};

/// Finds the mode by Gauss-Newton steps in gain form (the iterated extended Kalman filter of Bell and Cathey,
/// 1993), with the motion's own error in the state, so that what bends the motion stays on its curve. A step
/// that does not lower the cost is halved. Where the first step leads to the cost that it foresees, the frame
/// is as good as linear, and the prior's mean is returned as the point of linearisation.
///
/// @param before pose and map before the motion; its covariance may be singular
/// @param motion since then
/// @return nothing where the sightings' covariance has no root
std::optional<FrameMode> frame_mode(const JointBelief& before, const ChordBelief& motion,
                                    std::span<const SeenLandmark> seen);

/// The belief after a motion, to first order at the mode of a frame.
JointBelief predict_at(const FrameMode& mode, JointBelief before, const ChordBelief& motion);

}  // namespace stereobench::slam
