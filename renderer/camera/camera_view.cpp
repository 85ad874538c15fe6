#include "renderer/camera/camera_view.h"

#include <stdexcept>

#include "vision/camera/distortion.h"

namespace stereobench::renderer {
namespace {

/// Rows of the projection: clip = P (X, Y, Z, 1).
Eigen::Matrix4d projection(const vision::Intrinsics& camera) {
  const double width = camera.width_px;
  const double height = camera.height_px;
  Eigen::Matrix4d result = Eigen::Matrix4d::Zero();
  result(0, 0) = 2.0 * camera.focal_px / width;
  result(0, 2) = 2.0 * (camera.cx_px + 0.5) / width - 1.0;  // pixel (0, 0) is a centre: the edge is at -0.5
  result(1, 1) = 2.0 * camera.focal_px / height;
  result(1, 2) = 2.0 * (camera.cy_px + 0.5) / height - 1.0;
  result(2, 3) = kNear_m;
  result(3, 2) = 1.0;
  return result;
}

}  // namespace

CameraView camera_view(const vision::StereoRig& rig, vision::Side side, const slam::Pose& world_from_robot) {
  const Eigen::Isometry3d placed = Eigen::Translation3d(world_from_robot.x_m, world_from_robot.y_m, 0.0) *
                                   Eigen::AngleAxisd(world_from_robot.heading_rad, Eigen::Vector3d::UnitZ()) *
                                   vision::robot_from_camera(rig, side);
  return {placed.inverse(), rig.intrinsics, side == vision::Side::kLeft ? 0 : rig.intrinsics.width_px};
}

Eigen::Vector3d line_of_sight(const CameraView& view, const Eigen::Vector2d& pixel_px) {
  const Eigen::Vector3d arriving = vision::pixel_ray(view.intrinsics, pixel_px);
  if (view.lens == vision::Distortion{}) return arriving;
  const Eigen::Vector2d place = arriving.head<2>();
  auto direction = vision::undistort(view.lens, place, place);
  if (!direction) direction = vision::undistort(view.lens, place);
  if (!direction) throw std::invalid_argument("line_of_sight: the lens folds its picture");
  return direction->homogeneous();
}

Eigen::Vector2d shown_at(const CameraView& view, const Eigen::Vector3d& point_in_camera) {
  if (view.lens == vision::Distortion{}) return vision::project(view.intrinsics, point_in_camera);
  return vision::project(view.intrinsics,
                         vision::distort(view.lens, point_in_camera.hnormalized()).homogeneous());
}

Eigen::Vector4d clip_point(const vision::Intrinsics& camera, const Eigen::Vector3d& point_in_camera) {
  return projection(camera) * point_in_camera.homogeneous();
}

Eigen::Vector2d device_point(const vision::Intrinsics& camera, const Eigen::Vector2d& pixel_px) {
  return {2.0 * (pixel_px.x() + 0.5) / camera.width_px - 1.0,
          2.0 * (pixel_px.y() + 0.5) / camera.height_px - 1.0};
}

glm::mat4 clip_from_world(const CameraView& view) {
  const Eigen::Matrix4d matrix = projection(view.intrinsics) * view.camera_from_world.matrix();
  glm::mat4 result(1.0F);
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) result[column][row] = static_cast<float>(matrix(row, column));
  }
  return result;
}

std::array<Eigen::Vector4d, 5> frustum_in_camera(const vision::Intrinsics& camera) {
  const Eigen::Matrix4d clip = projection(camera);
  const Eigen::Vector4d w = clip.row(3);
  const Eigen::Vector4d x = clip.row(0);
  const Eigen::Vector4d y = clip.row(1);
  return {Eigen::Vector4d(0.0, 0.0, 1.0, -kNear_m), w + x, w - x, w + y, w - y};
}

}  // namespace stereobench::renderer
