/// Sub-pixel outlines of balls: the ellipse that explains how much of each rim pixel the ball covers.
#pragma once

#include <optional>

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "vision/colour/blobs.h"
#include "vision/outline/edge_profile.h"
#include "vision/outline/light_source.h"
#include "vision/types.h"

namespace stereobench::vision {

/// A ball's outline as one camera measures it.
struct MeasuredOutline {
  int colour = 0;                                            ///< index into kPalette
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();       ///< of the ellipse
  double radius_px = 0.0;                                    ///< of the circle of the same area
  Eigen::Matrix3d covariance_px2 = Eigen::Matrix3d::Zero();  ///< of (centre, radius)
  double reduced_chi_square =
      1.0;                        ///< how much more its arcs scatter than they should (variances), at least 1
  double inlier_ratio = 0.0;      ///< of the outline, that speaks for it; above 0.25, or 0.2 if learned
  double hidden_fraction = 0.0;   ///< of the outline's area, hidden by something in front of it, in [0, 1]
  double outside_fraction = 0.0;  ///< of the outline's area, beyond the image border, in [0, 1]
  long seen_px = 0;               ///< pixels of the patch that it was found by
  BallLight light;                ///< on what is seen of the ball
  EdgeProfile edge;               ///< what its rim shows, for the picture's blur
};

/// What outlines are fitted with.
struct FitSettings {
  Intrinsics camera;
  double noise_sd_levels = 0.0;
  double min_radius_px = 3.0;  ///< outlines of less than 0.98 of it are not measured
  double blur_px = 0.0;        ///< standard deviation of the Gaussian that the picture makes of a point
  bool resampled = false;      ///< whether the picture was interpolated
};

/// Fits a ball's outline (centre and radius of an ellipse of known shape) around a patch of colour.
///
/// Each arc of about three rim pixels is unmixed into ball and background and says how far the edge is from
/// where the model has it (Gauss-Newton on the coverage, weighted by what the arc can know); arcs that are
/// hidden, cut off, without contrast or at odds with the rest do not count. The edge starts as a wide ramp,
/// for a poor start, and ends as the pixels' own box filter, for precision, or as the blurred edge of a
/// picture out of focus. A patch that shows a part of a ball only is fitted once more from the circle that
/// its boundary suggests.
/// @param image CV_8UC3, BGR
/// @return empty when there is no ball's outline around the patch
std::optional<MeasuredOutline> fit_outline(const cv::Mat& image, const Blob& blob,
                                           const FitSettings& settings);

/// Measures an outline once more by what other balls tell of the light source, which matters where a ball's
/// own pixels tell little: small ones, and those whose lit part is a sliver at the rim.
/// @param outline as fit_outline left it
/// @return `outline` itself where the arcs no longer make one
MeasuredOutline refine_outline(const cv::Mat& image, const MeasuredOutline& outline,
                               const SharedLightSource& light_source, const FitSettings& settings);

}  // namespace stereobench::vision
