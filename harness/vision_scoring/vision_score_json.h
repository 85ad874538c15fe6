/// A vision score as JSON, for CBOR between processes.
#pragma once

#include "harness/json/cbor.h"
#include "harness/vision_scoring/vision_score.h"

namespace stereobench::vision {
STEREOBENCH_ALL_FIELDS(Intrinsics, width_px, height_px, focal_px, cx_px, cy_px)
STEREOBENCH_ALL_FIELDS(FaultSums, information, evidence, squares)
STEREOBENCH_ALL_FIELDS(RigWatch, rows, sizes, balls)
}  // namespace stereobench::vision

namespace stereobench::harness {
STEREOBENCH_ALL_FIELDS(RigCheck, camera, baseline_m, watch, sized)
STEREOBENCH_ALL_FIELDS(VisionScore, visible, found, observations, right, misidentified, spurious, repeated,
                       flagged, range_errors_m, bearing_errors_rad, disparity_errors_px, normalised_errors,
                       rig)
}  // namespace stereobench::harness
