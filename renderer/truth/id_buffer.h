/// What cameras look at, exactly: from where, and which primitive of the world each pixel's centre sees.
#pragma once

#include <array>

#include <opencv2/core.hpp>

#include "renderer/camera/camera_view.h"

namespace stereobench::renderer {

/// One camera's look. With the world's geometry (scene_geometry.h) all else follows in double precision.
struct IdBuffer {
  CameraView view;
  cv::Mat primitive;  ///< CV_32SC1, numbers of primitives.h
};

/// The primitives that the four pixels around a place see; those nearest to it, where it is not in the
/// picture.
std::array<int, 4> primitives_around(const cv::Mat& primitives, const Eigen::Vector2d& place_px);

struct StereoIdBuffers {
  IdBuffer left;
  IdBuffer right;
};

}  // namespace stereobench::renderer
