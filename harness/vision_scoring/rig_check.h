/// How far a rig is off what it is believed to be, as the detections of a run tell.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "vision/stereo/ball_fit.h"
#include "vision/stereo/rig_watch.h"
#include "vision/types.h"

namespace stereobench::harness {

/// Differences between both cameras, summed over detections of one believed rig.
struct RigCheck {
  vision::Intrinsics camera;
  double baseline_m = 0.0;  ///< as believed; 0 while nothing was detected
  vision::RigWatch watch;
  long sized = 0;  ///< detections whose radii were measured

  RigCheck& operator+=(const RigCheck& other);
};

/// What trusted detections tell of their rig; those without pixels tell nothing, those without measured
/// radii of rows alone. Any detector's are alike: each difference counts as if outlines were known to 0.02
/// px.
/// @param believed the rig by which they were detected
/// @param size that balls are made to
RigCheck check_rig(const vision::StereoRig& believed, const vision::BallSize& size,
                   std::span<const vision::BallObservation> observations);

/// `rows_off_px`: by how many rows the left camera sees things further down, at the left and the right end of
/// the middle row, and its standard deviation. `size_disagrees`: by what share disparities of 40 px are
/// larger than sizes say. Null where nothing tells.
nlohmann::ordered_json rig_json(const RigCheck& check);

/// A line for each of both that cannot be chance: how large it is, and what a calibration would repair.
std::vector<std::string> rig_warnings(const RigCheck& check);

}  // namespace stereobench::harness
