/// The vocabulary of calibration by a board: what was shown, what was seen of it, what follows.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "vision/camera/camera_pair.h"
#include "vision/types.h"

namespace stereobench::harness {

/// A chessboard: its inner corners, where four squares meet.
struct Board {
  int columns = 9;
  int rows = 6;
  double square_m = 0.0;  ///< the side of a square

  int corners() const { return columns * rows; }
  /// Where a corner is on the board, row by row, metres.
  Eigen::Vector3d corner_m(int index) const {
    return {square_m * (index % columns), square_m * (index / columns), 0.0};
  }
};

/// What both cameras saw of the board at one instant; all corners in the board's order.
struct BoardView {
  std::string name;
  std::array<std::vector<Eigen::Vector2d>, 2> corners_px;  ///< left, right
};

/// Which cameras a rig is taken to be made of.
enum class RigModel {
  kTwoCameras,  ///< each camera has its own focal length, centre and lens, and is turned as it is
  kOneCamera    ///< the same camera twice, the right one moved along the left one's rows and turned
};

/// A lens's coefficients in the order k1, k2, p1, p2, k3: which of them are estimated; others are zero.
using FreeCoefficients = std::array<bool, 5>;

/// A camera as estimated: focal length across, centre (x, y), k1, k2, p1, p2, k3, pixel aspect (focal length
/// down over that across); pixels where they have a unit.
constexpr int kCameraSize = 9;
using CameraParameters = Eigen::Matrix<double, kCameraSize, 1>;
constexpr int kK3 = 7;      ///< where k3 is
constexpr int kAspect = 8;  ///< where the pixel aspect is

/// The fit of a rig to views, and how well each parameter is known (standard deviations; zero where a
/// parameter is not estimated).
struct RigFit {
  std::array<CameraParameters, 2> cameras, cameras_sd;
  Eigen::Vector3d turn_rad = Eigen::Vector3d::Zero();  ///< left_from_right as a rotation vector
  Eigen::Vector3d turn_sd_rad = Eigen::Vector3d::Zero();
  Eigen::Vector3d right_in_left_m = Eigen::Vector3d::Zero();  ///< the right camera's centre
  Eigen::Vector3d right_in_left_sd_m = Eigen::Vector3d::Zero();
  std::vector<std::array<double, 2>> view_rms_px;  ///< of distances, by view and camera
  double rms_px = 0.0;                             ///< of distances, over all corners in both cameras
  double corner_sd_px = 0.0;                       ///< of each coordinate of a corner, as the fit has it
  double neighbour_sd_px = 0.0;  ///< the same from how much neighbours' errors differ: what is not smooth
  double clustering = 1.0;       ///< how much errors of one view hang together (residual_facts.h), at least 1
  double squares_px2 = 0.0;      ///< the sum of squared residuals
  long degrees_of_freedom = 0;   ///< residuals less parameters
  double tilt_spread_rad = 0.0;  ///< the largest angle between two views' boards
};

}  // namespace stereobench::harness
