#include "vision/camera/eye_pair.h"

#include <cmath>

#include "vision/camera/distortion.h"
#include "vision/camera/rig.h"

namespace stereobench::vision {

EyePair eyes_of(const StereoRig& rig) {
  EyePair eyes;
  for (const Eye eye : {Eye::kLeft, Eye::kRight}) {
    EyeCamera& camera = eyes[static_cast<std::size_t>(eye)];
    camera.camera = rig.camera;
    camera.lens = rig.distortion;
    for (int axis = 0; axis < 3; ++axis)
      camera.rectified_from_eye.row(axis) =
          direction_in_eye(rig, Eigen::Vector3d::Unit(axis), eye).transpose();
  }
  return eyes;
}

Eigen::Vector2d image_point(const EyeCamera& eye, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d in_eye = eye.rectified_from_eye.transpose() * direction;
  return project(eye.camera, distort(eye.lens, in_eye.hnormalized()).homogeneous());
}

bool is_usable(const EyeCamera& eye) {
  constexpr double kRounding = 1e-9;
  const Eigen::Matrix3d& turn = eye.rectified_from_eye;
  const StereoRig rig{.camera = eye.camera, .distortion = eye.lens};
  return is_usable(rig) && turn.allFinite() && turn.isUnitary(kRounding) && turn.determinant() > 0.0 &&
         directions_seen(eye.lens, eye.camera).has_value();
}

}  // namespace stereobench::vision
