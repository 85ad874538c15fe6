/// Which truth there is of a scenario's pictures.
#pragma once

#include "harness/dataset/truth/truth_request.h"
#include "vision/types.h"
#include "worlds/camera_sensor.h"

namespace stereobench::harness {

/// Refuses truth that has no one answer. Rows that look one after another, and frames that come late or not
/// at all, leave shifts between pictures undefined; behind a lens, or where rows look one after another, the
/// outline of a ball is no ellipse.
/// @throws std::runtime_error, one line that names the kind and the scenario's line
void require_truth(const TruthRequest& request, const vision::StereoRig& rig, const worlds::Shutter& shutter);

}  // namespace stereobench::harness
