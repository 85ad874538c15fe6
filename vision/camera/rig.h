/// Where a stereo rig's eyes are on the robot, and how points become pixels and pixels rays.
#pragma once

#include <optional>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "vision/types.h"

namespace stereobench::vision {

/// Where an eye is on the robot: the optical centre at height_m, half a baseline to its side, tilted by the
/// pitch.
/// @param eye the right eye is the left one moved by the baseline along its own x axis, and turned
/// @return the transform that takes points of the eye's camera frame to the robot frame, metres
Eigen::Isometry3d robot_from_camera(const StereoRig& rig, Eye eye = Eye::kLeft);

/// The same point as another eye of the rig sees it.
/// @param point_in_left_camera metres
/// @return the point in the frame of the eye's camera, metres
Eigen::Vector3d point_in_eye(const StereoRig& rig, const Eigen::Vector3d& point_in_left_camera, Eye eye);

/// The same direction as another eye of the rig sees it.
Eigen::Vector3d direction_in_eye(const StereoRig& rig, const Eigen::Vector3d& direction_in_left_camera,
                                 Eye eye);

/// Where an eye's picture shows a point: the pinhole projection after the lens has bent the light.
/// @param point_in_eye metres, in the frame of the eye's camera, Z > 0
/// @return pixels; may lie outside the image
Eigen::Vector2d image_point(const StereoRig& rig, const Eigen::Vector3d& point_in_eye);

/// The pinhole projection u = f X/Z + cx, v = f Y/Z + cy.
/// @param point_in_camera metres, Z > 0 (for Z <= 0 the result has no meaning)
/// @return pixels, (0, 0) is the centre of the top-left pixel; may lie outside the image
Eigen::Vector2d project(const Intrinsics& camera, const Eigen::Vector3d& point_in_camera);

/// Where a camera without distortion would show what a pixel of an eye's picture shows.
/// @return empty where the lens folds its picture
std::optional<Eigen::Vector2d> pinhole_point(const StereoRig& rig, const Eigen::Vector2d& taken_px);

/// Where a rig without faults, its right eye straight and its lenses without distortion, would show what a
/// pixel of an eye's picture shows.
/// @return empty where the lens folds its picture, or for what that rig has behind it
std::optional<Eigen::Vector2d> straight_point(const StereoRig& rig, const Eigen::Vector2d& taken_px, Eye eye);

/// Whether a place lies within the area of a picture's pixels.
bool is_inside(const Intrinsics& camera, const Eigen::Vector2d& pixel);

/// As project, for points that may be anywhere.
/// @return pixels within the image's area; empty when the point is behind the camera or outside the image
std::optional<Eigen::Vector2d> project_if_visible(const Intrinsics& camera,
                                                  const Eigen::Vector3d& point_in_camera);

/// The line of sight of a pixel.
/// @param pixel_px (0, 0) is the centre of the top-left pixel; fractions are fine
/// @return the point of the ray with Z = 1 in the camera frame
Eigen::Vector3d pixel_ray(const Intrinsics& camera, const Eigen::Vector2d& pixel_px);

/// Whether a rig can be computed with: finite, positive focal length, pixels, baseline and image size.
bool is_usable(const StereoRig& rig);

}  // namespace stereobench::vision
