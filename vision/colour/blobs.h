/// Connected patches of one palette colour: where balls may be.
#pragma once

#include <opencv2/core.hpp>

#include "vision/colour/colour_table.h"
#include "vision/scratch.h"

namespace stereobench::vision {

/// A patch of pixels of one palette colour that touch by sides or corners.
struct Blob {
  int colour = 0;      ///< index into the palette
  long area_px = 0;    ///< number of pixels, > 0
  double sum_x = 0.0;  ///< first moments: sums of the pixels' columns and rows
  double sum_y = 0.0;
  int min_x = 0;  ///< bounding box, inclusive
  int max_x = 0;
  int min_y = 0;
  int max_y = 0;
};

/// Finds the patches of palette colours in one pass over the image: runs of equal colour per row, joined to
/// the runs of the row above that they touch.
/// @param image CV_8UC3, BGR; row padding is fine
/// @param min_area_px smaller patches are left out
/// @param table which pixels have which colour
/// @return in the order in which their first pixels come, row by row
ScratchVector<Blob> find_blobs(const cv::Mat& image, long min_area_px,
                               const ColourTable& table = palette_table());

}  // namespace stereobench::vision
