#include "vision/camera/pinhole_rig.h"

#include <algorithm>

#include "vision/camera/distortion.h"

namespace stereobench::vision {
namespace {

constexpr int kMargin_px = 2;  // for the interpolation at the border

}  // namespace

std::optional<StereoRig> pinhole_rig(const StereoRig& rig) {
  const auto seen = directions_seen(rig.distortion, rig.intrinsics);
  if (!seen) return std::nullopt;
  StereoRig pinhole = rig;
  pinhole.distortion = {};
  Intrinsics& camera = pinhole.intrinsics;
  camera.focal_px = kPinholeDensity * rig.intrinsics.focal_px;
  const Eigen::Vector2d first = (camera.focal_px * seen->min()).array().floor() - kMargin_px;
  const Eigen::Vector2d last = (camera.focal_px * seen->max()).array().ceil() + kMargin_px;
  const Eigen::Vector2d size = last - first;
  camera.cx_px = -first.x();
  camera.cy_px = -first.y();
  camera.width_px = static_cast<int>(size.x()) + 1;
  camera.height_px = static_cast<int>(size.y()) + 1;
  return pinhole;
}

bool can_be_drawn(const Intrinsics& pinhole) {
  return std::max(pinhole.width_px, pinhole.height_px) <= kLargestPinhole_px;
}

}  // namespace stereobench::vision
