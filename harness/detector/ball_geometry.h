/// Where a ball is by its pixels, and which pixels it has by its place, in a rig as it is believed to be.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "vision/stereo/sphere.h"
#include "vision/types.h"

namespace stereobench::harness {

/// What one has to know of a ball to place it.
struct BallGeometry {
  vision::StereoRig rig;  ///< as it is believed to be
  double radius_m = 0.05;
};

/// The outlines that a ball must have where it is.
struct ExpectedOutlines {
  std::optional<vision::OutlineEllipse> left, right;  ///< none where a camera cannot see it
};

/// The centres as a rig without faults would have them.
struct RectifiedCentres {
  std::optional<Eigen::Vector2d> left, right;  ///< none where the lens folds its picture
};

/// Where a ball at the height of the cameras is, in the left camera's frame, m.
Eigen::Vector3d at_camera_height(const vision::StereoRig& rig, const slam::RangeBearing& seen);

/// The outlines of a ball at `ball_in_camera`.
ExpectedOutlines expected_outlines(const BallGeometry& geometry, const vision::BallObservation& ball);

/// Gives a ball the pixels and radii that it must have where only its place is known, `ball_in_camera`.
/// @return false, and nothing is changed, where a camera cannot see it
bool imagine_pixels(const BallGeometry& geometry, vision::BallObservation& ball);

/// The centres of a ball's pixels as a rig without faults would have them.
RectifiedCentres rectified_centres(const BallGeometry& geometry, const vision::BallObservation& ball);

/// Where a ball is by its centres, in the left camera's frame, m.
/// @return empty where a centre is missing or the disparity is not positive
std::optional<Eigen::Vector3d> place_of(const BallGeometry& geometry, const RectifiedCentres& centres);

/// Range, bearing and covariance that a ball's place and its centres' pixels stand for.
/// @param sd_px standard deviation of each coordinate of a centre
slam::RangeBearing seen_through(const BallGeometry& geometry, const vision::BallObservation& ball,
                                double sd_px);

}  // namespace stereobench::harness
