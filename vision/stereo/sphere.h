/// What a ball's outline is in an image, and where the ball is given its outlines in both cameras: closed
/// forms.
///
/// A sphere's outline is the cone of rays that touch it, cut by the image plane: an ellipse whose centre is
/// not the projected centre of the sphere. Holds exactly, without approximation.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "vision/types.h"

namespace stereobench::vision {

/// An ellipse in an image.
struct OutlineEllipse {
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
  double semi_major_px = 0.0;  ///< points away from the principal point
  double semi_minor_px = 0.0;
  double angle_rad = 0.0;  ///< of the major axis, from the image's x axis towards its y axis (down)

  /// Radius of the circle of the same area, px.
  double radius_px() const;

  /// Half the width and the height of the upright box around it.
  Eigen::Vector2d half_extent_px() const;
};

/// The outline of a ball: with b^2 = R^2 / (Z^2 - R^2), the centre is (1 + b^2) times the projected ball
/// centre (normalised coordinates), the semi-axes are b and b sqrt((D^2 - R^2) / (Z^2 - R^2)), D the ball's
/// distance.
/// @param ball_in_camera centre, in the frame of the camera that looks, metres
/// @param radius_m > 0
/// @return the ellipse, which may lie outside the image; empty when the ball is not wholly ahead (Z <= R)
std::optional<OutlineEllipse> sphere_outline(const Intrinsics& camera, const Eigen::Vector3d& ball_in_camera,
                                             double radius_m);

/// A ball and its size: X, Y, Z of its centre in the camera that looks, and its radius, metres.
using SizedBall = Eigen::Vector4d;

/// What a camera sees of a ball, and how that changes with the ball.
struct SeenOutline {
  Eigen::Vector3d outline_px = Eigen::Vector3d::Zero();  ///< centre, and radius of the circle of equal area
  Eigen::Matrix<double, 3, 4> by_ball = Eigen::Matrix<double, 3, 4>::Zero();  ///< its derivative
};

/// The outline of sphere_outline with its derivative by the ball's place and size.
/// @param ball wholly ahead (Z > R > 0)
SeenOutline seen_outline(const Intrinsics& camera, const SizedBall& ball);

/// Whether an outline lies within the area of the image's pixels.
bool lies_inside(const Intrinsics& camera, const OutlineEllipse& outline);

/// Ellipse centres triangulate to Z - R^2/Z; this undoes it: Z = (Zn + sqrt(Zn^2 + 4 R^2)) / 2.
/// @param triangulated_depth_m Zn = f B / disparity of the ellipse centres, > 0
/// @return depth of the ball's centre, metres, > 0
double ball_depth(double triangulated_depth_m, double radius_m);

/// Where a ball is, from its outlines' centres in a rectified rig; X and Y of ellipse centres are exact.
/// @param left_px centre of the outline's ellipse in the left image
/// @param right_px the same in the right image; the row is the mean of both
/// @return the ball's centre in the left camera's frame, metres; empty when the disparity is not positive
std::optional<Eigen::Vector3d> triangulate_ball(const StereoRig& rig, const Eigen::Vector2d& left_px,
                                                const Eigen::Vector2d& right_px, double radius_m);

}  // namespace stereobench::vision
