/// What balls leave of the light behind them, pixel by pixel.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "renderer/balls/ball_outline.h"

namespace stereobench::renderer {

/// The balls before a camera, as ball_shader.h draws them.
class BallVeil {
 public:
  /// No balls.
  BallVeil() = default;

  /// @param outlines of the balls that the camera sees
  /// @param rows of the camera's picture that pixels are counted in
  BallVeil(const CameraView& view, std::vector<BallOutline> outlines, const cv::Range& rows);

  const std::vector<BallOutline>& outlines() const { return outlines_; }

  /// The boxes of the picture beyond which there is no ball; some may be empty.
  const std::vector<cv::Rect>& boxes() const { return boxes_; }

  /// The share of a pixel that balls which are nearer than a depth leave free, in [0, 1].
  /// @param inverse_depth of what is behind them, 1/m
  float light_left(const cv::Point& pixel, double inverse_depth) const;

 private:
  std::vector<BallOutline> outlines_;
  std::vector<cv::Rect> boxes_;  // of each outline
  cv::Point origin_;             // of the picture in the framebuffer
};

/// What a ball is at a pixel.
struct BallCover {
  double share = 0.0;          ///< of the pixel that it covers, in [0, 1]
  double inverse_depth = 0.0;  ///< of the ball, 1/m
};

/// The equations of ball_shader.h, in double precision.
/// @param pixel in the framebuffer
BallCover cover(const BallOutline& outline, const cv::Point& pixel);

}  // namespace stereobench::renderer
