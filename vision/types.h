/// The vocabulary of the vision stage: cameras, stereo pairs, balls as they are observed.
///
/// Frame **camera**: OpenCV optical axes, x right, y down, z forward; the left camera is the
/// reference. Pixel (0, 0) is the centre of the top-left pixel.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "slam/types.h"

namespace stereobench::vision {

enum class Side { kLeft = 0, kRight = 1 };

/// A pinhole camera without distortion; both cameras of a rectified rig share it.
struct Intrinsics {
  int width_px = 1024;
  int height_px = 768;
  double focal_px = 887.0;
  double cx_px = 511.5;  ///< principal point; the image centre is ((width - 1) / 2, (height - 1) / 2)
  double cy_px = 383.5;
};

/// How a camera's picture differs from a pinhole's with square pixels, see distortion.h. Coefficients of the
/// lens and their order are OpenCV's and ROS's plumb_bob.
struct Distortion {
  double k1 = 0.0, k2 = 0.0;  ///< radial
  double p1 = 0.0, p2 = 0.0;  ///< of a lens that is not centred
  double k3 = 0.0;            ///< radial
  double pixel_aspect = 1.0;  ///< fy / fx: a pixel's width over its height; > 0

  bool operator==(const Distortion&) const = default;
};

/// A stereo rig and how it sits on the robot: both optical centres at `height_m` above the floor, half a
/// baseline left and right of the robot's origin, looking forward and `pitch_down_rad` down. It is rectified
/// unless the right camera is turned, the lenses distort, or pixels are not square.
struct StereoRig {
  Intrinsics intrinsics;        ///< of both cameras
  double baseline_m = 0.12;     ///< > 0
  double height_m = 0.30;       ///< above the floor
  double pitch_down_rad = 0.0;  ///< positive looks at the floor
  /// How the right camera is turned against the left one: first about its z axis, then y, then x.
  Eigen::Vector3d right_turn_rad = Eigen::Vector3d::Zero();
  Distortion distortion;  ///< of both cameras' lenses, and their pixels' aspect
};

/// The two images of one instant, 8-bit BGR, linear light.
struct StereoPair {
  cv::Mat left;   ///< CV_8UC3
  cv::Mat right;  ///< CV_8UC3
};

/// One ball seen by both cameras.
struct BallObservation {
  int colour = slam::kUnknown;                        ///< index into the palette
  Eigen::Vector2d left_px = Eigen::Vector2d::Zero();  ///< centre of the outline's ellipse
  Eigen::Vector2d right_px = Eigen::Vector2d::Zero();
  double left_radius_px = 0.0;  ///< of the circle of the same area
  double right_radius_px = 0.0;
  bool has_radii = true;   ///< false: radii are made up of where the ball is
  bool has_pixels = true;  ///< false: range and bearing are all that was seen, and the pixels are made up
  Eigen::Vector3d ball_in_camera = Eigen::Vector3d::Zero();  ///< centre in the left camera's frame, m
  slam::RangeBearing range_bearing;  ///< in the robot frame; colour_class is set, landmark_id is not
  bool truncated = false;            ///< cut by the image border, in a camera, by more than can be measured
  bool occluded = false;             ///< hidden, in a camera, by more than can be measured
  /// True when the measurement can be trusted as far as its covariance says.
  bool trusted() const { return !truncated && !occluded; }
};

}  // namespace stereobench::vision
