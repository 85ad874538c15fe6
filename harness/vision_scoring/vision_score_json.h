/// A vision score as JSON, for CBOR between processes.
#pragma once

#include "harness/io/cbor.h"
#include "harness/vision_scoring/vision_score.h"

namespace stereobench::vision {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Intrinsics, width_px, height_px, focal_px, cx_px, cy_px)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FaultSums, information, evidence, squares)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RigWatch, rows, sizes, balls)
}  // namespace stereobench::vision

namespace stereobench::harness {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RigCheck, camera, baseline_m, watch)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(VisionScore, visible, found, observations, right, misidentified, spurious,
                                   repeated, flagged, range_errors_m, bearing_errors_rad, disparity_errors_px,
                                   normalised_errors, rig)
}  // namespace stereobench::harness
