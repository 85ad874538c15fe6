/// What a camera sees, in GL's terms. The only place that knows GL's axes and rows.
///
/// Pictures have their row 0 in GL's row 0, so nothing is ever flipped: y points down in the camera, in the
/// picture and, by this projection, in clip space. Depth is reversed and has no far end: GL stores n / Z,
/// which keeps the relative error of a float at every distance.
#pragma once

#include <array>

#include <Eigen/Geometry>
#include <glm/mat4x4.hpp>

#include "vision/camera/rig.h"

namespace stereobench::renderer {

inline constexpr double kNear_m = 0.01;  ///< nothing nearer than this plane is seen

/// One camera at one instant, and where its picture lies in the framebuffer that both cameras share.
struct CameraView {
  Eigen::Isometry3d camera_from_world = Eigen::Isometry3d::Identity();
  vision::Intrinsics intrinsics;
  int first_column_px = 0;
  vision::Distortion lens;  ///< none where the rasteriser draws: its lines are straight

  /// The camera's optical centre, world frame, metres.
  Eigen::Vector3d centre_in_world() const { return camera_from_world.inverse().translation(); }
};

/// @param world_from_robot the robot's pose in the plane
CameraView camera_view(const vision::StereoRig& rig, vision::Side side, const slam::Pose& world_from_robot);

/// The point of a pixel's line of sight with Z = 1, in the camera frame.
/// @param pixel_px (0, 0) is the centre of the top-left pixel
/// @throws std::invalid_argument where the lens folds its picture
Eigen::Vector3d line_of_sight(const CameraView& view, const Eigen::Vector2d& pixel_px);

/// Where a camera's picture shows a point, px; may lie outside of it.
/// @param point_in_camera Z > 0 and, with a lens, a direction that it does not fold
Eigen::Vector2d shown_at(const CameraView& view, const Eigen::Vector3d& point_in_camera);

/// A point of the camera frame in clip space, w = Z.
Eigen::Vector4d clip_point(const vision::Intrinsics& camera, const Eigen::Vector3d& point_in_camera);

/// Normalised device coordinates of a place in the picture.
Eigen::Vector2d device_point(const vision::Intrinsics& camera, const Eigen::Vector2d& pixel_px);

/// The matrix that does clip_point for points of the world frame.
glm::mat4 clip_from_world(const CameraView& view);

/// The planes of what the camera sees: near, left, right, top, bottom.
/// @return normals in the camera frame and offsets: a point is inside where normal . point + offset >= 0
std::array<Eigen::Vector4d, 5> frustum_in_camera(const vision::Intrinsics& camera);

}  // namespace stereobench::renderer
