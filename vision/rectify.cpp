#include "vision/rectify.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <opencv2/imgproc.hpp>

#include "slam/elementary.h"
#include "vision/distortion.h"
#include "vision/rig.h"

namespace stereobench::vision {
namespace {

constexpr std::array<Eye, 2> kEyes = {Eye::kLeft, Eye::kRight};

bool has_faults(const StereoRig& rig) {
  return !(rig.distortion == Distortion{}) || !rig.right_turn_rad.isZero(0.0);
}

Eigen::AlignedBox2d checked_view(const StereoRig& rig) {
  if (!is_usable(rig)) throw std::invalid_argument("Rectification: the rig cannot be computed with");
  const auto seen = directions_seen(rig.distortion, rig.camera);
  if (!seen) throw std::invalid_argument("Rectification: the lens folds its picture");
  return *seen;
}

/// What either eye sees, as directions of the left one.
Eigen::AlignedBox2d seen_by_both(const StereoRig& rig, const Eigen::AlignedBox2d& seen) {
  Eigen::AlignedBox2d all = seen;
  const Eigen::Matrix3d left_from_right =
      robot_from_camera(rig).linear().transpose() * robot_from_camera(rig, Eye::kRight).linear();
  for (const auto corner : {Eigen::AlignedBox2d::BottomLeft, Eigen::AlignedBox2d::BottomRight,
                            Eigen::AlignedBox2d::TopLeft, Eigen::AlignedBox2d::TopRight}) {
    const Eigen::Vector3d direction = left_from_right * seen.corner(corner).homogeneous();
    if (direction.z() > 0.0) all.extend(direction.hnormalized());
  }
  return all;
}

/// The same rig with the right eye put straight, lenses that do not distort, and pictures that hold a view.
StereoRig rectified(StereoRig rig, const Eigen::AlignedBox2d& view) {
  Intrinsics& camera = rig.camera;
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

Rectification::Rectification(const StereoRig& rig) : taken_(rig), rectified_(rig), seen_(checked_view(rig)) {
  if (!has_faults(rig)) return;
  rectified_ = rectified(rig, seen_by_both(rig, seen_));
  for (const Eye eye : kEyes) {
    cv::Mat places(rectified_.camera.height_px, rectified_.camera.width_px, CV_32FC2);
    for (int row = 0; row < places.rows; ++row) {
      for (int column = 0; column < places.cols; ++column) {
        const Eigen::Vector2f at = taken_px(Eigen::Vector2d(column, row), eye).cast<float>();
        places.at<cv::Vec2f>(row, column) = {at.x(), at.y()};
      }
    }
    Maps& maps = maps_[static_cast<std::size_t>(eye)];
    cv::convertMaps(places, cv::noArray(), maps.places, maps.fractions, CV_16SC2);
  }
}

StereoPair Rectification::apply(const StereoPair& pair) const {
  return {rectified_picture(pair.left, Eye::kLeft), rectified_picture(pair.right, Eye::kRight)};
}

Eigen::Vector2d Rectification::taken_px(const Eigen::Vector2d& rectified_px, Eye eye) const {
  constexpr double kNowhere_px = -1e4;
  const Eigen::Vector3d direction = direction_in_eye(taken_, pixel_ray(rectified_.camera, rectified_px), eye);
  const bool seen =
      direction.z() > 0.0 && seen_.contains(direction.hnormalized());  // beyond, lenses may fold
  return seen ? image_point(taken_, direction) : Eigen::Vector2d(kNowhere_px, kNowhere_px);
}

bool Rectification::shows(const Eigen::Vector2d& centre_px, double radius_px, Eye eye) const {
  constexpr int kPoints = 32;
  for (int i = 0; i < kPoints; ++i) {
    const auto [s, c] = slam::sine_cosine(2.0 * std::numbers::pi * i / kPoints);
    if (!is_inside(taken_.camera, taken_px(centre_px + radius_px * Eigen::Vector2d(c, s), eye))) return false;
  }
  return true;
}

cv::Mat Rectification::rectified_picture(const cv::Mat& taken, Eye eye) const {
  const Intrinsics& camera = taken_.camera;
  if (taken.type() != CV_8UC3 || taken.cols != camera.width_px || taken.rows != camera.height_px)
    throw std::invalid_argument("Rectification: pictures must be 8-bit BGR of the rig's size");
  const Maps& maps = maps_[static_cast<std::size_t>(eye)];
  if (maps.places.empty()) return taken;
  cv::Mat picture;
  cv::remap(taken, picture, maps.places, maps.fractions, cv::INTER_CUBIC, cv::BORDER_CONSTANT);
  return picture;
}

}  // namespace stereobench::vision
