/// COCO's masks by lengths of runs.
#pragma once

#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

#include "harness/json/json_line.h"

namespace stereobench::harness {

/// Columns first; of pixels that are not of the mask, of those that are, and so on.
struct RunLengths {
  cv::Size size;
  std::vector<std::int64_t> runs;

  std::int64_t pixels() const;
  std::int64_t pixels_of_mask() const;
};

/// A segmentation: "size" and "counts", which is a list, or the text that pycocotools makes of it.
/// @throws BadLine for what is neither
RunLengths run_lengths_of(const JsonValue& segmentation);

/// @param runs have as many pixels as their size
/// @return CV_8UC1: 255 for pixels of the mask
cv::Mat mask_of(const RunLengths& runs);

}  // namespace stereobench::harness
