/// One ball through both cameras: where it is, from all that its two outlines say.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "vision/outline/outline_fit.h"
#include "vision/types.h"

namespace stereobench::vision {

/// A ball that explains two outlines.
struct BallFit {
  Eigen::Vector3d ball_in_camera = Eigen::Vector3d::Zero();  ///< left camera, metres
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();   ///< of it
  double radius_m = 0.0;                                     ///< as the outlines tell it
  double radius_variance_m2 = 0.0;                           ///< of that
  double row_misfit_px = 0.0;                                ///< between the cameras, absolute
  double radius_misfit_px = 0.0;  ///< to balls of the known size, of the worse camera, absolute
};

/// The ball of about known size whose outlines suit what both cameras measured best: the one by which
/// outlines are matched.
///
/// Generalised least squares over (X, Y, Z, R): three numbers a camera, each camera's with their covariance.
/// The size is held to ten percent only, so that disparity and size can be seen to contradict each other. A
/// whole outline's centre says nothing of its radius, and its ball is where the centres triangulate to. Of an
/// outline that is seen in part, centre and radius are uncertain together, and what the other camera says of
/// the radius helps to fix the centre.
/// @param ball_radius_m > 0
/// @param disparity_variance_px2 of what the disparity may be off beyond the outlines' errors, which is the
///   right camera's fault; 0 for a rig that is as believed
/// @return empty when the outlines' centres have no positive disparity, though they should
std::optional<BallFit> fit_ball(const StereoRig& rig, const MeasuredOutline& left,
                                const MeasuredOutline& right, double ball_radius_m,
                                double disparity_variance_px2 = 0.0);

/// The disparity of balls of a size whose outlines are as large as these: f B b sqrt(1 + b^2) / R, b being
/// the outlines' semi-minor axis at unit depth, their mean (sphere.h).
double disparity_by_size_px(const StereoRig& rig, const MeasuredOutline& left, const MeasuredOutline& right,
                            double ball_radius_m);

/// How large balls are, and how well that is known.
struct BallSize {
  double radius_m = 0.0;     ///< > 0
  double radius_sd_m = 0.0;  ///< tolerance of manufacture; 0 is exactly known
};

/// The same ball by all that is known of its size: the outlines' size tells depth as well, f R / r.
///
/// The size counts by its tolerance. Where it contradicts the disparity by more than five standard
/// deviations, the ball is of another size or the rig is not as believed: either is taken to be off by as
/// much.
/// @param loose fit_ball's, of the same outlines
/// @param disparity_variance_px2 as fit_ball's
/// @return `loose` itself where no ball of that size explains the outlines
BallFit fit_ball_of_size(const StereoRig& rig, const MeasuredOutline& left, const MeasuredOutline& right,
                         const BallSize& size, const BallFit& loose, double disparity_variance_px2 = 0.0);

}  // namespace stereobench::vision
