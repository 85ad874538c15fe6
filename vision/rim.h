/// The pixels around a ball's outline.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "vision/outline_model.h"
#include "vision/shading.h"

namespace stereobench::vision {

/// A pixel near the outline.
struct RimPixel {
  Eigen::Vector2d position_px = Eigen::Vector2d::Zero();
  Eigen::Vector3d bgr = Eigen::Vector3d::Zero();
  /// What the ball would show here, BGR, as far as its shading is known; zero when nothing is, and
  /// far outside.
  Eigen::Vector3d shade = Eigen::Vector3d::Zero();
  double distance_px = 0.0;  ///< from the outline that it was collected for, positive outside
  std::size_t sector = 0;    ///< which arc of the outline it belongs to
};

/// The pixels of the image that are near an outline, sorted into short arcs.
struct Rim {
  std::vector<RimPixel> pixels;  ///< row by row
  std::size_t sectors = 0;
  bool has_shades = false;  ///< whether the ball's shading was known
};

/// Collects the pixels at most `reach_px` inside or outside of the outline, in arcs of about three pixels.
/// @param image CV_8UC3; pixels outside it are missing from the rim
/// @param shading of the ball, where it is known
Rim collect_rim(const cv::Mat& image, const OutlineModel& outline, double reach_px,
                const std::optional<Shading>& shading);

}  // namespace stereobench::vision
