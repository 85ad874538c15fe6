/// The pixels around a ball's outline.
#pragma once

#include <optional>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include "vision/outline/outline_model.h"
#include "vision/outline/shading.h"
#include "vision/scratch.h"

namespace stereobench::vision {

/// Colours are (B, G, R, 1) here, so that sums count what they sum and means and noise come out of one
/// matrix. Sums over the pixels of an arc and of their products are whole numbers that single precision
/// holds.
using Colour = Eigen::Vector4f;

/// A pixel that an outline may cross.
struct RimPixel {
  Eigen::Vector2d position_px = Eigen::Vector2d::Zero();
  Colour colour = Colour::Zero();
  /// What the ball would show here as far as its shading is known; black while nothing is.
  Colour shade = Colour::Zero();
  double distance_px = 0.0;  ///< from the outline that it was collected for, positive outside
  std::size_t sector = 0;    ///< which arc of the outline it belongs to
};

/// Sums over pixels that show the ball, wholly or in part.
struct BallSums {
  Colour colour = Colour::Zero();
  Colour shade = Colour::Zero();

  void add(const RimPixel& pixel) {
    colour += pixel.colour;
    shade += pixel.shade;
  }
  void add(const BallSums& other) {
    colour += other.colour;
    shade += other.shade;
  }
  double count() const { return colour.w(); }
  Eigen::Vector3d mean() const { return colour.cast<double>().hnormalized(); }
  Eigen::Vector3d mean_shade() const { return shade.cast<double>().hnormalized(); }
};

/// Sums over pixels that show the background alone.
struct BackgroundSums {
  Eigen::Matrix4f moments = Eigen::Matrix4f::Zero();  ///< of each colour with itself
  Colour by_distance = Colour::Zero();                ///< of each colour with its distance from the outline
  double distance2 = 0.0;

  void add(const Colour& colour, double distance_px) {
    moments.noalias() += colour * colour.transpose();
    by_distance.noalias() += static_cast<float>(distance_px) * colour;
    distance2 += distance_px * distance_px;
  }
  double count() const { return moments(3, 3); }
  Eigen::Vector4d sums() const { return moments.col(3).cast<double>(); }
  Eigen::Vector4d sums_by_distance() const { return by_distance.cast<double>(); }
  double mean_distance_px() const { return sums_by_distance().w() / count(); }
  Eigen::Vector3d mean() const { return sums().hnormalized(); }

  /// Sum of the squares about the mean, channel by channel.
  Eigen::Matrix3d scatter() const {
    return moments.topLeftCorner<3, 3>().cast<double>() - sums().head<3>() * mean().transpose();
  }
};

/// What is seen along one arc of an outline.
struct RimArc {
  BallSums inside;         ///< just inside of the outline
  BallSums crossed;        ///< where the outline goes
  BackgroundSums outside;  ///< just outside
};

/// What an image shows along an outline.
struct Rim {
  ScratchVector<RimPixel> pixels;  ///< that the outline may cross, row by row
  ScratchVector<RimArc> arcs;      ///< of about three pixels' length, once around
  bool has_shades = false;         ///< whether the ball's shading was known
};

/// How much of a rim is looked at: all of it, or of a large one every other row where rows cross it steeply,
/// in arcs twice as long.
enum class Detail { kAll, kCoarse };

/// Collects the pixels near an outline, and the colours beside it in rings of two pixels' width, more where
/// it is blurred; outside of an outline whose shading is known, of five.
/// @param image CV_8UC3; pixels outside it are missing from the rim
/// @param gap_px between the outline and either ring; nearer pixels may be of both colours
/// @param shading of the ball, where it is known
/// @param detail a glance is enough to see whether a ball is whole and about where the outline is
Rim collect_rim(const cv::Mat& image, const OutlineModel& outline, double gap_px,
                const std::optional<Shading>& shading, Detail detail);

}  // namespace stereobench::vision
