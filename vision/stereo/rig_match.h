/// The balls of one pair of pictures, matched by what is known of the rig, and what they tell of it.
#pragma once

#include <span>

#include "vision/observer_settings.h"
#include "vision/scratch.h"
#include "vision/stereo/rig_watch.h"
#include "vision/stereo/stereo_match.h"

namespace stereobench::vision {

/// Pairs of outlines, the rig that they suit, and what is known of it with them.
struct Matched {
  ScratchVector<OutlinePair> pairs;
  StereoRig rig;  ///< with the baseline that is believed to be right
  RigWatch watch;
  double camera_variance_m2 =
      0.0;  ///< of where the left camera is beside the robot's middle, half a baseline away
};

/// Whether both outlines of a pair tell where the ball is: enough of them is seen, and their arcs are of
/// one thing as far as they tell.
bool speaks(const OutlinePair& pair, const StereoRig& rig);

/// Matches by what pairs before have told of the rig, and again by what this one tells. Where most outlines
/// have no partner, the rig is searched for anew (rig_search.h); what comes of that counts if it matches
/// more balls, and more than all pairs before have told by.
/// @param watch what pairs before have told
Matched match_by_watch(std::span<const MeasuredOutline> left, std::span<const MeasuredOutline> right,
                       const StereoRig& rig, const ObserverSettings& settings, const RigWatch& watch);

}  // namespace stereobench::vision
