/// A rig of two different cameras, as real ones are: each eye has its own focal length, centre and lens, and
/// looks its own way.
#pragma once

#include <array>

#include <Eigen/Core>

#include "vision/types.h"

namespace stereobench::vision {

/// One eye: a camera, and how it is turned in the rig.
struct EyeCamera {
  Intrinsics camera;
  Distortion lens;
  /// Takes directions of the eye's frame to the rectified one, whose x axis points from the left eye to the
  /// right one.
  Eigen::Matrix3d rectified_from_eye = Eigen::Matrix3d::Identity();
};

/// Both eyes of a rig, left and right; their pictures have one size.
using EyePair = std::array<EyeCamera, 2>;

/// The eyes of a rig whose cameras are one camera twice.
EyePair eyes_of(const StereoRig& rig);

/// Where an eye's picture shows a direction.
/// @param direction in the rectified frame, in front of the eye
/// @return pixels; may lie outside the picture
Eigen::Vector2d image_point(const EyeCamera& eye, const Eigen::Vector3d& direction);

/// Whether an eye can be computed with: finite, positive focal length and size, a rotation, and a lens that
/// does not fold its picture.
bool is_usable(const EyeCamera& eye);

}  // namespace stereobench::vision
