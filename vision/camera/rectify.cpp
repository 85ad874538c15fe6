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

constexpr std::array<Eye, 2> kEyes = {Eye::kLeft, Eye::kRight};

std::size_t index_of(Eye eye) {
  return static_cast<std::size_t>(eye);
}

bool is_straight(const EyeCamera& eye, const Intrinsics& camera) {
  return eye.lens == Distortion{} && eye.rectified_from_eye.isIdentity(0.0) &&
         eye.camera.focal_px == camera.focal_px && eye.camera.cx_px == camera.cx_px &&
         eye.camera.cy_px == camera.cy_px;
}

void check(const StereoRig& rig, const EyePair& eyes) {
  const Intrinsics& camera = rig.camera;
  if (!is_usable(rig)) throw std::invalid_argument("Rectification: the rig cannot be computed with");
  for (const EyeCamera& eye : eyes) {
    if (!is_usable(eye)) throw std::invalid_argument("Rectification: the lens folds its picture, or no eye");
    if (eye.camera.width_px != camera.width_px || eye.camera.height_px != camera.height_px)
      throw std::invalid_argument("Rectification: the eyes' pictures must have the rig's size");
  }
}

/// What either eye sees, as directions of the rectified frame.
Eigen::AlignedBox2d seen_by_both(const EyePair& eyes, const std::array<Eigen::AlignedBox2d, 2>& seen) {
  Eigen::AlignedBox2d all;
  for (const Eye eye : kEyes) {
    for (const auto corner : {Eigen::AlignedBox2d::BottomLeft, Eigen::AlignedBox2d::BottomRight,
                              Eigen::AlignedBox2d::TopLeft, Eigen::AlignedBox2d::TopRight}) {
      const Eigen::Vector3d direction =
          eyes[index_of(eye)].rectified_from_eye * seen[index_of(eye)].corner(corner).homogeneous();
      if (direction.z() > 0.0) all.extend(direction.hnormalized());
    }
  }
  return all;
}

/// The same rig with its eyes put straight, lenses that do not distort, and pictures that hold a view.
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

Rectification::Rectification(const StereoRig& rig) : Rectification(rig, eyes_of(rig)) {}

Rectification::Rectification(const StereoRig& rig, const EyePair& eyes) : eyes_(eyes), rectified_(rig) {
  check(rig, eyes);
  for (const Eye eye : kEyes)
    seen_[index_of(eye)] = *directions_seen(eyes[index_of(eye)].lens, eyes[index_of(eye)].camera);
  if (is_straight(eyes[0], rig.camera) && is_straight(eyes[1], rig.camera)) return;
  rectified_ = rectified(rig, seen_by_both(eyes, seen_));
  for (const Eye eye : kEyes) {
    cv::Mat places(rectified_.camera.height_px, rectified_.camera.width_px, CV_32FC2);
    for (int row = 0; row < places.rows; ++row) {
      for (int column = 0; column < places.cols; ++column) {
        const Eigen::Vector2f at = pixel_for(Eigen::Vector2d(column, row), eye).cast<float>();
        places.at<cv::Vec2f>(row, column) = {at.x(), at.y()};
      }
    }
    Maps& maps = maps_[index_of(eye)];
    cv::convertMaps(places, cv::noArray(), maps.places, maps.fractions, CV_16SC2);
  }
}

StereoPair Rectification::apply(const StereoPair& pair) const {
  return {rectified_picture(pair.left, Eye::kLeft), rectified_picture(pair.right, Eye::kRight)};
}

Eigen::Vector2d Rectification::direction_of(const Eigen::Vector2d& rectified_px, Eye eye) const {
  constexpr double kLeastAhead = 1e-6;  // what is behind the eye is as far aside as can be
  const Eigen::Vector3d ray = pixel_ray(rectified_.camera, rectified_px);
  const Eigen::Vector3d direction = eyes_[index_of(eye)].rectified_from_eye.transpose() * ray;
  return direction.head<2>() / std::max(direction.z(), kLeastAhead);
}

Eigen::Vector2d Rectification::taken_px(const Eigen::Vector2d& rectified_px, Eye eye) const {
  const EyeCamera& taken_by = eyes_[index_of(eye)];
  const Eigen::AlignedBox2d& seen = seen_[index_of(eye)];
  const Eigen::Vector2d direction = direction_of(rectified_px, eye);
  const Eigen::Vector2d nearest = direction.cwiseMax(seen.min()).cwiseMin(seen.max());
  const Eigen::Vector2d beyond = direction - nearest;  // where lenses may fold
  return project(taken_by.camera, distort(taken_by.lens, nearest).homogeneous()) +
         taken_by.camera.focal_px * Eigen::Vector2d(beyond.x(), taken_by.lens.pixel_aspect * beyond.y());
}

Eigen::Vector2d Rectification::pixel_for(const Eigen::Vector2d& rectified_px, Eye eye) const {
  constexpr double kNowhere_px = -1e4;
  const bool seen = seen_[index_of(eye)].contains(direction_of(rectified_px, eye));
  return seen ? taken_px(rectified_px, eye) : Eigen::Vector2d(kNowhere_px, kNowhere_px);
}

bool Rectification::shows(const Eigen::Vector2d& centre_px, double radius_px, Eye eye) const {
  constexpr int kPoints = 32;
  for (int i = 0; i < kPoints; ++i) {
    const auto [s, c] = slam::sine_cosine(2.0 * slam::kPi * i / kPoints);
    if (!is_inside(eyes_[index_of(eye)].camera,
                   pixel_for(centre_px + radius_px * Eigen::Vector2d(c, s), eye)))
      return false;
  }
  return true;
}

cv::Mat Rectification::rectified_picture(const cv::Mat& taken, Eye eye) const {
  const Intrinsics& camera = eyes_[index_of(eye)].camera;
  if (taken.type() != CV_8UC3 || taken.cols != camera.width_px || taken.rows != camera.height_px)
    throw std::invalid_argument("Rectification: pictures must be 8-bit BGR of the rig's size");
  const Maps& maps = maps_[index_of(eye)];
  if (maps.places.empty()) return taken;
  cv::Mat picture;
  cv::remap(taken, picture, maps.places, maps.fractions, cv::INTER_CUBIC, cv::BORDER_CONSTANT);
  return picture;
}

}  // namespace stereobench::vision
