/// The frames that changed most between two results, before and after side by side.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "harness/page/page.h"
#include "harness/regression/detection_changes.h"
#include "harness/result_pages/detection_row.h"

namespace stereobench::harness {

/// A result's detections, and where its pictures are.
struct ResultFrames {
  std::filesystem::path folder;
  std::span<const DetectionRow> rows;
};

/// Four panels a frame: A and B of the left camera, then of the right one. Where one result alone has kept
/// the pair, its picture stands for both.
/// @return without frames where neither result has kept pictures, so that nobody knows the camera
/// @throws std::runtime_error for a calibration that cannot be read
PageFrames changed_frames(const ResultFrames& first, const ResultFrames& second,
                          std::span<const ChangedFrame> frames);

}  // namespace stereobench::harness
