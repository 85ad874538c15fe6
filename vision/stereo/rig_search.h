/// A rig whose rows are not where they should be: what it may be off by, found in one pair of pictures.
#pragma once

#include <optional>
#include <span>

#include "vision/observer_settings.h"
#include "vision/outline/outline_fit.h"
#include "vision/stereo/rig_watch.h"

namespace stereobench::vision {

/// The turn about x and z under which most outlines have a partner of their colour and size in the other
/// camera, each one of its own, with one common trend of the rows: tried are all that two such pairs, or a
/// lone one, suggest. Of disparities it says nothing but that they may be wrong.
/// @return a belief coarse enough for outlines to be matched by; empty where nothing could be a pair
std::optional<RigBelief> search_rig(std::span<const MeasuredOutline> left,
                                    std::span<const MeasuredOutline> right, const StereoRig& rig,
                                    const ObserverSettings& settings);

}  // namespace stereobench::vision
