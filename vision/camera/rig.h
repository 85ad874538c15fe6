/// Where a stereo rig's cameras are on the robot, and how points become pixels and pixels rays.
#pragma once

#include <optional>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "vision/types.h"

namespace stereobench::vision {

/// Where a camera is on the robot: the optical centre at height_m, half a baseline to its side, tilted by the
/// pitch.
/// @param side the right camera is the left one moved by the baseline along its own x axis, and turned
/// @return the transform that takes points of the camera's frame to the robot frame, metres
Eigen::Isometry3d robot_from_camera(const StereoRig& rig, Side side = Side::kLeft);

/// The same point as another camera of the rig sees it.
/// @param point_in_left_camera metres
/// @return the point in that camera's frame, metres
Eigen::Vector3d camera_point(const StereoRig& rig, const Eigen::Vector3d& point_in_left_camera, Side side);

/// The same direction as another camera of the rig sees it.
Eigen::Vector3d camera_direction(const StereoRig& rig, const Eigen::Vector3d& direction_in_left_camera,
                                 Side side);

/// Where a camera's picture shows a point: the pinhole projection after the lens has distorted it.
/// @param point_in_camera metres, Z > 0
/// @return pixels; may lie outside the image
Eigen::Vector2d image_point(const StereoRig& rig, const Eigen::Vector3d& point_in_camera);

/// The pinhole projection u = f X/Z + cx, v = f Y/Z + cy.
/// @param point_in_camera metres, Z > 0 (for Z <= 0 the result has no meaning)
/// @return pixels, (0, 0) is the centre of the top-left pixel; may lie outside the image
inline Eigen::Vector2d project(const Intrinsics& camera, const Eigen::Vector3d& point_in_camera) {
  return {camera.cx_px + camera.focal_px * point_in_camera.x() / point_in_camera.z(),
          camera.cy_px + camera.focal_px * point_in_camera.y() / point_in_camera.z()};
}

/// Where a camera without distortion would show what a pixel of a camera's picture shows.
/// @return empty where the lens folds its picture
std::optional<Eigen::Vector2d> pinhole_point(const StereoRig& rig, const Eigen::Vector2d& taken_px);

/// Where a rig without faults, its right camera not turned and its lenses without distortion, would show what
/// a pixel of a camera's picture shows.
/// @return empty where the lens folds its picture, or for what that rig has behind it
std::optional<Eigen::Vector2d> rectified_point(const StereoRig& rig, const Eigen::Vector2d& taken_px,
                                               Side side);

/// Whether a place lies within the area of a picture's pixels.
inline bool is_inside(const Intrinsics& camera, const Eigen::Vector2d& pixel) {
  return pixel.x() >= -0.5 && pixel.x() <= camera.width_px - 0.5 && pixel.y() >= -0.5 &&
         pixel.y() <= camera.height_px - 0.5;
}

/// As project, for points that may be anywhere.
/// @return pixels within the image's area; empty when the point is behind the camera or outside the image
std::optional<Eigen::Vector2d> project_if_visible(const Intrinsics& camera,
                                                  const Eigen::Vector3d& point_in_camera);

/// The line of sight of a pixel.
/// @param pixel_px (0, 0) is the centre of the top-left pixel; fractions are fine
/// @return the point of the ray with Z = 1 in the camera frame
inline Eigen::Vector3d pixel_ray(const Intrinsics& camera, const Eigen::Vector2d& pixel_px) {
  return {(pixel_px.x() - camera.cx_px) / camera.focal_px, (pixel_px.y() - camera.cy_px) / camera.focal_px,
          1.0};
}

/// Whether a rig can be computed with: finite, positive focal length, pixels, baseline and image size.
bool is_usable(const StereoRig& rig);

}  // namespace stereobench::vision
