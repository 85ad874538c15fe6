#include "vision/camera/rectify.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <opencv2/imgproc.hpp>

#include "slam/math/angles.h"
#include "slam/math/elementary.h"
#include "vision/camera/distortion.h"
#include "vision/camera/rig.h"

namespace stereobench::vision {
namespace {

constexpr std::array<Side, 2> kSides = {Side::kLeft, Side::kRight};

std::size_t index_of(Side side) {
  return static_cast<std::size_t>(side);
}

bool is_rectified(const CameraModel& camera, const Intrinsics& intrinsics) {
  return camera.lens == Distortion{} && camera.rectified_from_camera.isIdentity(0.0) &&
         camera.intrinsics.focal_px == intrinsics.focal_px && camera.intrinsics.cx_px == intrinsics.cx_px &&
         camera.intrinsics.cy_px == intrinsics.cy_px;
}

void check(const StereoRig& rig, const CameraPair& cameras) {
  const Intrinsics& size = rig.intrinsics;
  if (!is_usable(rig)) throw std::invalid_argument("Rectification: the rig cannot be computed with");
  for (const CameraModel& camera : cameras) {
    if (!is_usable(camera))
      throw std::invalid_argument("Rectification: a lens folds its picture, or a camera has no valid model");
    if (camera.intrinsics.width_px != size.width_px || camera.intrinsics.height_px != size.height_px)
      throw std::invalid_argument("Rectification: the cameras' pictures must have the rig's size");
  }
}

/// What either camera sees, as directions of the rectified frame.
Eigen::AlignedBox2d seen_by_both(const CameraPair& cameras, const std::array<Eigen::AlignedBox2d, 2>& seen) {
  Eigen::AlignedBox2d all;
  for (const Side side : kSides) {
    for (const auto corner : {Eigen::AlignedBox2d::BottomLeft, Eigen::AlignedBox2d::BottomRight,
                              Eigen::AlignedBox2d::TopLeft, Eigen::AlignedBox2d::TopRight}) {
      const Eigen::Vector3d direction =
          cameras[index_of(side)].rectified_from_camera * seen[index_of(side)].corner(corner).homogeneous();
      if (direction.z() > 0.0) all.extend(direction.hnormalized());
    }
  }
  return all;
}

/// The same rig with its cameras rectified, lenses that do not distort, and pictures that hold a view.
StereoRig rectified(StereoRig rig, const Eigen::AlignedBox2d& view) {
  Intrinsics& camera = rig.intrinsics;
  const Eigen::Array2d size(camera.width_px, camera.height_px);
  const Eigen::Array2d centre(camera.cx_px, camera.cy_px);
  const Eigen::Array2d first =
      (centre + camera.focal_px * view.min().array()).floor().max(-0.5 * size).floor();
  const Eigen::Array2d last = (centre + camera.focal_px * view.max().array()).ceil().min(1.5 * size).ceil();
  camera.cx_px -= first.x();
  camera.cy_px -= first.y();
  camera.width_px = static_cast<int>(last.x() - first.x()) + 1;
  camera.height_px = static_cast<int>(last.y() - first.y()) + 1;
  rig.right_turn_rad.setZero();
  rig.distortion = {};
  return rig;
}

}  // namespace

Rectification::Rectification(const StereoRig& rig) : Rectification(rig, cameras_of(rig)) {}

Rectification::Rectification(const StereoRig& rig, const CameraPair& cameras)
    : cameras_(cameras), rectified_(rig) {
  check(rig, cameras);
  for (const Side side : kSides)
    seen_[index_of(side)] =
        *directions_seen(cameras[index_of(side)].lens, cameras[index_of(side)].intrinsics);
  if (is_rectified(cameras[0], rig.intrinsics) && is_rectified(cameras[1], rig.intrinsics)) return;
  rectified_ = rectified(rig, seen_by_both(cameras, seen_));
  for (const Side side : kSides) {
    cv::Mat places(rectified_.intrinsics.height_px, rectified_.intrinsics.width_px, CV_32FC2);
    for (int row = 0; row < places.rows; ++row) {
      for (int column = 0; column < places.cols; ++column) {
        const Eigen::Vector2f at = pixel_for(Eigen::Vector2d(column, row), side).cast<float>();
        places.at<cv::Vec2f>(row, column) = {at.x(), at.y()};
      }
    }
    Maps& maps = maps_[index_of(side)];
    cv::convertMaps(places, cv::noArray(), maps.places, maps.fractions, CV_16SC2);
  }
}

StereoPair Rectification::apply(const StereoPair& pair) const {
  return {rectified_picture(pair.left, Side::kLeft), rectified_picture(pair.right, Side::kRight)};
}

Eigen::Vector2d Rectification::direction_of(const Eigen::Vector2d& rectified_px, Side side) const {
  constexpr double kLeastAhead = 1e-6;  // what is behind the camera is as far aside as can be
  const Eigen::Vector3d ray = pixel_ray(rectified_.intrinsics, rectified_px);
  const Eigen::Vector3d direction = cameras_[index_of(side)].rectified_from_camera.transpose() * ray;
  return direction.head<2>() / std::max(direction.z(), kLeastAhead);
}

Eigen::Vector2d Rectification::taken_px(const Eigen::Vector2d& rectified_px, Side side) const {
  const CameraModel& taken_by = cameras_[index_of(side)];
  const Eigen::AlignedBox2d& seen = seen_[index_of(side)];
  const Eigen::Vector2d direction = direction_of(rectified_px, side);
  const Eigen::Vector2d nearest = direction.cwiseMax(seen.min()).cwiseMin(seen.max());
  const Eigen::Vector2d beyond = direction - nearest;  // where lenses may fold
  return project(taken_by.intrinsics, distort(taken_by.lens, nearest).homogeneous()) +
         taken_by.intrinsics.focal_px * Eigen::Vector2d(beyond.x(), taken_by.lens.pixel_aspect * beyond.y());
}

Eigen::Vector2d Rectification::pixel_for(const Eigen::Vector2d& rectified_px, Side side) const {
  constexpr double kNowhere_px = -1e4;
  const bool seen = seen_[index_of(side)].contains(direction_of(rectified_px, side));
  return seen ? taken_px(rectified_px, side) : Eigen::Vector2d(kNowhere_px, kNowhere_px);
}

bool Rectification::shows(const Eigen::Vector2d& centre_px, double radius_px, Side side) const {
  constexpr int kPoints = 32;
  for (int i = 0; i < kPoints; ++i) {
    const auto [s, c] = slam::sine_cosine(2.0 * slam::kPi * i / kPoints);
    if (!is_inside(cameras_[index_of(side)].intrinsics,
                   pixel_for(centre_px + radius_px * Eigen::Vector2d(c, s), side)))
      return false;
  }
  return true;
}

cv::Mat Rectification::rectified_picture(const cv::Mat& taken, Side side) const {
  const Intrinsics& camera = cameras_[index_of(side)].intrinsics;
  if (taken.type() != CV_8UC3 || taken.cols != camera.width_px || taken.rows != camera.height_px)
    throw std::invalid_argument("Rectification: pictures must be 8-bit BGR of the rig's size");
  const Maps& maps = maps_[index_of(side)];
  if (maps.places.empty()) return taken;
  cv::Mat picture;
  cv::remap(taken, picture, maps.places, maps.fractions, cv::INTER_CUBIC, cv::BORDER_CONSTANT);
  return picture;
}

}  // namespace stereobench::vision
