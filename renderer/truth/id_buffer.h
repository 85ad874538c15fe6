/// What cameras look at, exactly: from where, and which primitive of the world each pixel's centre sees.
#pragma once

#include <algorithm>
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
inline std::array<int, 4> primitives_around(const cv::Mat& primitives, const Eigen::Vector2d& place_px) {
  const auto near = [](double coordinate, int size) {
    const double within = std::clamp(coordinate, -1.0, static_cast<double>(size));
    int low = static_cast<int>(within);  // towards 0
    if (within < low) --low;
    return std::array{std::clamp(low, 0, size - 1), std::clamp(low + 1, 0, size - 1)};
  };
  const auto [left, right] = near(place_px.x(), primitives.cols);
  const auto [above, below] = near(place_px.y(), primitives.rows);
  const int* const upper = primitives.ptr<int>(above);
  const int* const lower = primitives.ptr<int>(below);
  return {upper[left], upper[right], lower[left], lower[right]};
}

struct StereoIdBuffers {
  IdBuffer left;
  IdBuffer right;
};

}  // namespace stereobench::renderer
