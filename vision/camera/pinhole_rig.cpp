#include "vision/camera/pinhole_rig.h"

#include <algorithm>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "vision/camera/distortion.h"

namespace stereobench::vision {
namespace {

constexpr int kMargin_px = 2;  // neighbours of a place: one before it, two after it (renderer/camera/remap.h)

/// The density that the picture's middle needs for the least one along the border.
double density_for(const Distortion& lens, const std::vector<Eigen::Vector2d>& border) {
  double least_scale = 1.0;  // of the way of a pixel, in the pinhole's picture, against one in the middle
  for (const Eigen::Vector2d& direction : border) {
    const Eigen::Matrix2d by_distorted = distortion_slope(lens, direction).inverse();
    least_scale = std::min(least_scale, by_distorted.rowwise().norm().minCoeff());
  }
  return std::min(kLeastPinholeDensity / least_scale, kMostPinholeDensity);
}

}  // namespace

std::optional<StereoRig> pinhole_rig(const StereoRig& rig) {
  const auto border = border_directions(rig.distortion, rig.intrinsics);
  if (!border) return std::nullopt;
  Eigen::AlignedBox2d seen;
  for (const Eigen::Vector2d& direction : *border) seen.extend(direction);
  StereoRig pinhole = rig;
  pinhole.distortion = {};
  Intrinsics& camera = pinhole.intrinsics;
  camera.focal_px = density_for(rig.distortion, *border) * rig.intrinsics.focal_px;
  const Eigen::Vector2d first = (camera.focal_px * seen.min()).array().floor() - kMargin_px;
  const Eigen::Vector2d last = (camera.focal_px * seen.max()).array().ceil() + kMargin_px;
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
