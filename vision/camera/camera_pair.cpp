#include "vision/camera/camera_pair.h"

#include <cmath>

#include "vision/camera/distortion.h"
#include "vision/camera/rig.h"

namespace stereobench::vision {

CameraPair cameras_of(const StereoRig& rig) {
  CameraPair cameras;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    CameraModel& camera = cameras[static_cast<std::size_t>(side)];
    camera.intrinsics = rig.intrinsics;
    camera.lens = rig.distortion;
    for (int axis = 0; axis < 3; ++axis)
      camera.rectified_from_camera.row(axis) =
          camera_direction(rig, Eigen::Vector3d::Unit(axis), side).transpose();
  }
  return cameras;
}

Eigen::Vector2d image_point(const CameraModel& camera, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d in_camera = camera.rectified_from_camera.transpose() * direction;
  return project(camera.intrinsics, distort(camera.lens, in_camera.hnormalized()).homogeneous());
}

bool is_usable(const CameraModel& camera) {
  constexpr double kRounding = 1e-9;
  const Eigen::Matrix3d& turn = camera.rectified_from_camera;
  const StereoRig rig{.intrinsics = camera.intrinsics, .distortion = camera.lens};
  return is_usable(rig) && turn.allFinite() && turn.isUnitary(kRounding) && turn.determinant() > 0.0 &&
         directions_seen(camera.lens, camera.intrinsics).has_value();
}

}  // namespace stereobench::vision
