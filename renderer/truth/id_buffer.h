/// What cameras look at, exactly: from where, and which facet of the world each pixel's centre sees.
#pragma once

#include <array>

#include <opencv2/core.hpp>

#include "renderer/camera/camera_view.h"

namespace stereobench::renderer {

/// One camera's look. With the world's geometry (scene_geometry.h) all else follows in double precision.
struct IdBuffer {
  CameraView view;
  cv::Mat facet;  ///< CV_32SC1, numbers of facets.h
};

/// The facets that the four pixels around a place see; those nearest to it, where it is not in the picture.
std::array<int, 4> facets_around(const cv::Mat& facets, const Eigen::Vector2d& place_px);

struct StereoIdBuffers {
  IdBuffer left;
  IdBuffer right;
};

}  // namespace stereobench::renderer
