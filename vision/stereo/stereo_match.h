/// Which outline of the right camera is the same ball as which of the left.
#pragma once

#include <span>

#include "vision/observer_settings.h"
#include "vision/outline/outline_fit.h"
#include "vision/scratch.h"
#include "vision/stereo/ball_fit.h"
#include "vision/stereo/rig_watch.h"

namespace stereobench::vision {

/// The same ball's outline in both cameras.
struct OutlinePair {
  MeasuredOutline left;
  MeasuredOutline
      right;     ///< where the camera would see it without the fault that the rig is believed to have
  BallFit ball;  ///< that explains both
  bool sizes_agree = true;  ///< both radii are what a whole ball at the triangulated place must have
  double disparity_variance_px2 = 0.0;  ///< of what is not known of the fault; 0 for a rig without
  Eigen::Vector2d right_px = Eigen::Vector2d::Zero();  ///< the right outline as it is seen
  double right_radius_px = 0.0;
};

/// Pairs outlines of one colour on one row whose disparity is positive and whose radii suit the depth that
/// the disparity gives (f R / Z for balls of known radius). Only mutual best partners are paired.
/// @param rig with the baseline of the belief
/// @param belief in the rig's fault: the right camera's turn is undone as far as it is known
ScratchVector<OutlinePair> match_outlines(std::span<const MeasuredOutline> left,
                                          std::span<const MeasuredOutline> right, const StereoRig& rig,
                                          const ObserverSettings& settings, const RigBelief& belief);

}  // namespace stereobench::vision
