/// The pixels around a ball's outline and the two colours that mix in them.
#pragma once

#include <vector>

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "vision/outline_model.h"

namespace stereobench::vision {

/// A pixel near the outline.
struct RimPixel {
  Eigen::Vector2d position_px = Eigen::Vector2d::Zero();
  Eigen::Vector3d bgr = Eigen::Vector3d::Zero();
  double distance_px = 0.0;  ///< from the outline that it was collected for, positive outside
  std::size_t sector = 0;    ///< which arc of the outline it belongs to
};

/// The pixels of the image that are near an outline, sorted into short arcs.
struct Rim {
  std::vector<RimPixel> pixels;  ///< row by row
  std::size_t sectors = 0;
};

/// Collects the pixels at most `reach_px` inside or outside of the outline, in arcs of about three pixels.
/// @param image CV_8UC3; pixels outside it are missing from the rim
Rim collect_rim(const cv::Mat& image, const OutlineModel& outline, double reach_px);

/// How a pixel of one arc is split into ball and background: alpha = unmix . (bgr - background).
struct ArcColours {
  Eigen::Vector3d background = Eigen::Vector3d::Zero();  ///< BGR, just outside
  Eigen::Vector3d unmix = Eigen::Vector3d::Zero();       ///< per level; zero where the arc shows nothing
  double noise_variance = 0.0;                           ///< of a pixel's alpha, from image noise
  double texture_variance =
      0.0;              ///< of a pixel's alpha, since texture is not the same at the rim as beside it
  bool usable = false;  ///< the ball's colour inside, another one outside, enough contrast
};

/// What arc colours are judged by.
struct UnmixSettings {
  Eigen::Vector3d ball_bgr = Eigen::Vector3d::Zero();  ///< palette colour, any brightness
  double noise_sd_levels = 0.0;
  double gap_px = 0.9;  ///< colours are sampled this far from the outline and two pixels further
};

/// Samples both colours of each arc and prepares the unmixing I = alpha ball + (1 - alpha) background.
/// The ball's brightness at the very rim is known from further inside only to some 12 % (Lambert shading
/// changes fastest there), so differences along the ball's own colour count for little. Neither do
/// differences along which the background's texture varies, which is brightness more than chromaticity. The
/// background is extrapolated to the rim where it changes steadily.
std::vector<ArcColours> arc_colours(const Rim& rim, const UnmixSettings& settings);

/// The shades of a ball's colour: what lies near the line from black through it.
class Shades {
 public:
  /// @param ball_bgr any brightness
  /// @param noise_levels standard deviation of the channels of the colours to be tested
  Shades(const Eigen::Vector3d& ball_bgr, double noise_levels)
      : line_(ball_bgr.normalized()), noise_tolerance_(3.0 * noise_levels) {}

  /// Whether a colour is a shade of the ball's.
  bool contain(const Eigen::Vector3d& bgr) const;

 private:
  Eigen::Vector3d line_;
  double noise_tolerance_;
};

}  // namespace stereobench::vision
