/// One ball through both eyes: where it is, from all that its two outlines say.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "vision/outline_fit.h"
#include "vision/types.h"

namespace stereobench::vision {

/// A ball that explains two outlines.
struct BallFit {
  Eigen::Vector3d ball_in_camera = Eigen::Vector3d::Zero();  ///< left camera, metres
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();   ///< of it
  double row_misfit_px = 0.0;                                ///< between the eyes, absolute
  double radius_misfit_px = 0.0;  ///< to balls of the known size, of the worse eye, absolute
};

/// The ball of about known size whose outlines suit what both eyes measured best.
///
/// Generalised least squares over (X, Y, Z, R): three numbers an eye, each eye's with their covariance. The
/// size is known to ten percent only, so that distance comes from disparity and not from a radius that blur
/// would change. A whole outline's centre says nothing of its radius, and its ball is where the centres
/// triangulate to. Of an outline that is seen in part, centre and radius are uncertain together, and what the
/// other eye says of the radius helps to fix the centre.
/// @param ball_radius_m > 0
/// @return empty when the outlines' centres have no positive disparity
std::optional<BallFit> fit_ball(const StereoRig& rig, const MeasuredOutline& left,
                                const MeasuredOutline& right, double ball_radius_m);

}  // namespace stereobench::vision
