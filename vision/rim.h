/// The pixels around a ball's outline.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "vision/outline_model.h"
#include "vision/shading.h"

namespace stereobench::vision {

/// A pixel that an outline may cross.
struct RimPixel {
  Eigen::Vector2d position_px = Eigen::Vector2d::Zero();
  Eigen::Vector3d bgr = Eigen::Vector3d::Zero();
  /// What the ball would show here, BGR, as far as its shading is known; zero when nothing is, and
  /// far outside.
  Eigen::Vector3d shade = Eigen::Vector3d::Zero();
  double distance_px = 0.0;  ///< from the outline that it was collected for, positive outside
  std::size_t sector = 0;    ///< which arc of the outline it belongs to
};

/// Sums over pixels that show the ball, wholly or in part.
struct BallSums {
  double count = 0.0;
  Eigen::Vector3d colour = Eigen::Vector3d::Zero();
  Eigen::Vector3d shade = Eigen::Vector3d::Zero();

  void add(const Eigen::Vector3d& bgr, const Eigen::Vector3d& expected) {
    count += 1.0;
    colour += bgr;
    shade += expected;
  }
  void add(const BallSums& other) {
    count += other.count;
    colour += other.colour;
    shade += other.shade;
  }
  Eigen::Vector3d mean() const { return colour / count; }
  Eigen::Vector3d beyond_shade() const { return (colour - shade) / count; }
};

/// Sums over pixels that show the background alone.
struct BackgroundSums {
  double count = 0.0;
  Eigen::Vector3d colour = Eigen::Vector3d::Zero();
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();  ///< of the channels
  Eigen::Vector3d crosses = Eigen::Vector3d::Zero();  ///< products of each channel and the next: BG, GR, RB

  void add(const Eigen::Vector3d& bgr) {
    count += 1.0;
    colour += bgr;
    squares += bgr.cwiseProduct(bgr);
    crosses += bgr.cwiseProduct(Eigen::Vector3d(bgr.y(), bgr.z(), bgr.x()));
  }
  void add(const BackgroundSums& other) {
    count += other.count;
    colour += other.colour;
    squares += other.squares;
    crosses += other.crosses;
  }
  Eigen::Vector3d mean() const { return colour / count; }

  /// Sum of the squares about the mean, channel by channel.
  Eigen::Matrix3d scatter() const;
};

/// What is seen along one arc of an outline.
struct RimArc {
  BallSums inside;         ///< just inside of the outline
  BallSums crossed;        ///< where the outline goes
  BackgroundSums outside;  ///< just outside
};

/// What an image shows along an outline.
struct Rim {
  std::vector<RimPixel> pixels;  ///< that the outline may cross, row by row
  std::vector<RimArc> arcs;      ///< of about three pixels' length, once around
  bool has_shades = false;       ///< whether the ball's shading was known
};

/// How far from the outline a pixel may be that a sharp outline crosses, once it is about right.
inline constexpr double kCrossed_px = 1.5;

/// Collects the pixels near an outline, and the colours beside it in rings of two pixels' width.
/// @param image CV_8UC3; pixels outside it are missing from the rim
/// @param gap_px between the outline and either ring; nearer pixels may be of both colours
/// @param shading of the ball, where it is known
Rim collect_rim(const cv::Mat& image, const OutlineModel& outline, double gap_px,
                const std::optional<Shading>& shading);

}  // namespace stereobench::vision
