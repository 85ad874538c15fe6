/// Where a patch of one colour ends, to a whole pixel, and circles that may go along there.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "vision/colour/blobs.h"
#include "vision/colour/colour_table.h"
#include "vision/scratch.h"

namespace stereobench::vision {

/// A circle in an image.
struct Circle {
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
  double radius_px = 0.0;
};

/// The boundary of a patch: the middles of the outer sides of the first and last pixels of its colour in each
/// row and each column of its box. Where that side is the image's border the patch is cut, and it is left
/// out.
/// @param image CV_8UC3, BGR
/// @param table that the patch was found with
ScratchVector<Eigen::Vector2d> patch_boundary(const cv::Mat& image, const Blob& blob,
                                              const ColourTable& table);

}  // namespace stereobench::vision
