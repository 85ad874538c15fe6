/// Lines of sight in the world frame.
#pragma once

#include "renderer/camera/camera_view.h"
#include "worlds/visibility/bvh.h"

namespace stereobench::renderer {

using worlds::Ray;

/// Whether a camera has no lens: asked once a picture, since it takes as long as a ray.
inline bool is_straight(const CameraView& view) {
  return view.lens == vision::Distortion{};
}

/// The rays of the pixels of a camera without a lens; t is planar depth.
class PinholeRays {
 public:
  explicit PinholeRays(const CameraView& view)
      : camera_(view.intrinsics),
        camera_m_(view.centre_in_world()),
        world_from_camera_(view.camera_from_world.linear().transpose()) {}

  /// @param u,v (0, 0) is the centre of the top-left pixel
  Ray operator()(double u, double v) const {
    return {camera_m_, world_from_camera_ * vision::pixel_ray(camera_, {u, v})};
  }

 private:
  vision::Intrinsics camera_;
  Eigen::Vector3d camera_m_;
  Eigen::Matrix3d world_from_camera_;
};

/// The same of any camera.
class PixelRays {
 public:
  explicit PixelRays(const CameraView& view)
      : view_(view),
        camera_m_(view.centre_in_world()),
        world_from_camera_(view.camera_from_world.linear().transpose()) {}

  /// @param u,v (0, 0) is the centre of the top-left pixel
  Ray operator()(double u, double v) const {
    return {camera_m_, world_from_camera_ * line_of_sight(view_, {u, v})};
  }

 private:
  CameraView view_;
  Eigen::Vector3d camera_m_;
  Eigen::Matrix3d world_from_camera_;
};

/// Where a camera without a lens shows points, as shown_at.
class PinholePlaces {
 public:
  explicit PinholePlaces(const CameraView& view) : camera_(view.intrinsics) {}
  Eigen::Vector2d operator()(const Eigen::Vector3d& point_in_camera) const {
    return vision::project(camera_, point_in_camera);
  }

 private:
  vision::Intrinsics camera_;
};

/// The same of any camera.
class PixelPlaces {
 public:
  explicit PixelPlaces(const CameraView& view) : view_(view) {}
  Eigen::Vector2d operator()(const Eigen::Vector3d& point_in_camera) const {
    return shown_at(view_, point_in_camera);
  }

 private:
  CameraView view_;
};

/// Calls a function with each run of a row's pixels that see one primitive: primitive, first column, end.
template <class Take>
void for_runs(const int* primitives, int width, const Take& take) {
  for (int begin = 0, end = 0; begin < width; begin = end) {
    while (end < width && primitives[end] == primitives[begin]) ++end;
    take(primitives[begin], begin, end);
  }
}

}  // namespace stereobench::renderer
