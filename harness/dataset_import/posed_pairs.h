/// Pairs whose pictures have a pose each, as pairs of one rig.
#pragma once

#include <optional>

#include "harness/dataset_import/imported_frames.h"

namespace stereobench::harness {

/// How far pairs are off their rig, at most.
struct PairSpread {
  double px = 0.0;     ///< by a turn: focal length times angle
  double share = 0.0;  ///< by a shift, of the baseline; a range of stereo is off by as much
};

/// Frames whose poses are those of single pictures (PosesOf::kEachCamera) become frames of one body, and
/// their cameras get their places on it. Others stay as they are.
///
/// Where the layout says where the robot is, that is the body, with the rig that vision is told. Else it is
/// the left camera, and the right one is where the poses of each pair have it in the mean. Numbers that are
/// short but for rounding become short.
/// @return where the rig is by poses of pairs, how well these agree
/// @throws std::runtime_error, one line, where there are no pairs, no poses or no lenses, or the cameras are
///   not fixed to each other: a pair is off the mean by more than 0.1 px, or 0.1 % of the baseline
std::optional<PairSpread> put_on_one_body(const DatasetView& view, ImportedFrames& imported);

}  // namespace stereobench::harness
