/// What eyes look at, exactly: from where, and which facet of the world each pixel's centre sees.
#pragma once

#include <opencv2/core.hpp>

#include "renderer/eye_view.h"

namespace stereobench::renderer {

/// One eye's look. With the world's geometry (scene_geometry.h) all else follows in double precision.
struct EyeSight {
  EyeView view;
  cv::Mat facet;  ///< CV_32SC1, numbers of facets.h
};

struct StereoSight {
  EyeSight left;
  EyeSight right;
};

}  // namespace stereobench::renderer
