/// Where the ball of a patch may be that shows only a part of it.
#pragma once

#include <optional>

#include <opencv2/core.hpp>

#include "vision/colour/blobs.h"
#include "vision/colour/patch_boundary.h"

namespace stereobench::vision {

/// The circle that most of a patch's boundary lies on.
///
/// What hides a part of a ball cuts its patch along some other line. Of all circles through three points of
/// the boundary the one that most of the boundary follows is the outline, as long as no cut is as long and as
/// round. Points on the image's border are cuts.
/// @param image CV_8UC3, BGR
/// @return empty when no circle explains a third of the boundary
std::optional<Circle> guess_from_boundary(const cv::Mat& image, const Blob& blob);

}  // namespace stereobench::vision
