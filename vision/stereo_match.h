/// Which outline of the right eye is the same ball as which of the left.
#pragma once

#include <span>

#include "vision/ball_fit.h"
#include "vision/observe.h"
#include "vision/outline_fit.h"
#include "vision/scratch.h"

namespace stereobench::vision {

/// The same ball's outline in both eyes.
struct OutlinePair {
  MeasuredOutline left;
  MeasuredOutline right;
  BallFit ball;             ///< that explains both
  bool sizes_agree = true;  ///< both radii are what a whole ball at the triangulated place must have
};

/// Pairs outlines of one colour on one row whose disparity is positive and whose radii suit the depth that
/// the disparity gives (f R / Z for balls of known radius). Only mutual best partners are paired.
ScratchVector<OutlinePair> match_outlines(std::span<const MeasuredOutline> left,
                                          std::span<const MeasuredOutline> right, const StereoRig& rig,
                                          const ObserverSettings& settings);

}  // namespace stereobench::vision
