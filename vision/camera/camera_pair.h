/// A rig of two different cameras, as real ones are: each has its own focal length, centre, lens and
/// direction.
#pragma once

#include <array>

#include <Eigen/Core>

#include "vision/types.h"

namespace stereobench::vision {

/// How one camera of a rig takes pictures, and how it is turned in the rig.
struct CameraModel {
  Intrinsics intrinsics;
  Distortion lens;
  /// Takes directions of the camera's frame to the rectified one, whose x axis points from the left camera to
  /// the right one.
  Eigen::Matrix3d rectified_from_camera = Eigen::Matrix3d::Identity();
};

/// Both cameras of a rig, left and right; their pictures have one size.
using CameraPair = std::array<CameraModel, 2>;

/// Both cameras of a rig that has the same model twice.
CameraPair cameras_of(const StereoRig& rig);

/// Where a camera's picture shows a direction.
/// @param direction in the rectified frame, in front of the camera
/// @return pixels; may lie outside the picture
Eigen::Vector2d image_point(const CameraModel& camera, const Eigen::Vector3d& direction);

/// Whether a camera can be computed with: finite, positive focal length and size, a rotation, and a lens that
/// does not fold its picture.
bool is_usable(const CameraModel& camera);

}  // namespace stereobench::vision
