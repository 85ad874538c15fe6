/// Lines of sight in the world frame.
#pragma once

#include "renderer/camera/camera_view.h"
#include "worlds/visibility/bvh.h"

namespace stereobench::renderer {

using worlds::Ray;

/// The rays of a camera's pixels; t is planar depth.
class PixelRays {
 public:
  explicit PixelRays(const CameraView& view)
      : view_(view),
        is_straight_(view.lens == vision::Distortion{}),
        camera_m_(view.centre_in_world()),
        world_from_camera_(view.camera_from_world.linear().transpose()) {}

  /// @param u,v (0, 0) is the centre of the top-left pixel
  Ray operator()(double u, double v) const {
    if (!is_straight_) return {camera_m_, world_from_camera_ * line_of_sight(view_, {u, v})};
    return {camera_m_, world_from_camera_ * vision::pixel_ray(view_.intrinsics, {u, v})};
  }

 private:
  CameraView view_;
  bool is_straight_;  ///< asked once: it takes as long as the ray
  Eigen::Vector3d camera_m_;
  Eigen::Matrix3d world_from_camera_;
};

/// shown_at for many points of one camera.
class PixelPlaces {
 public:
  explicit PixelPlaces(const CameraView& view)
      : view_(view), is_straight_(view.lens == vision::Distortion{}) {}

  /// @param point_in_camera as of shown_at
  Eigen::Vector2d operator()(const Eigen::Vector3d& point_in_camera) const {
    return is_straight_ ? vision::project(view_.intrinsics, point_in_camera)
                        : shown_at(view_, point_in_camera);
  }

 private:
  CameraView view_;
  bool is_straight_;
};

}  // namespace stereobench::renderer
