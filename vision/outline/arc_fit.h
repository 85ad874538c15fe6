/// One Gauss-Newton step of an outline: what its arcs say together.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "vision/outline/arc_colours.h"
#include "vision/outline/outline_model.h"
#include "vision/outline/rim.h"

namespace stereobench::vision {

/// How far the edge of one arc is outside of where the model has it.
struct ArcOffset {
  double offset_px = 0.0;
  double variance_px2 = 0.0;
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();
  double weight = 0.0;  ///< robust weight in [0, 1]; 0 for an arc that says nothing or contradicts the others
};

/// A change of (centre x, centre y, radius) that brings the model to where the arcs say the edge is.
struct OutlineStep {
  Eigen::Vector3d change_px = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_px2 = Eigen::Matrix3d::Zero();
  /// How much more the arcs scatter than they should, as a ratio of variances; 1 if no more than by chance.
  /// The covariance allows for it.
  double reduced_chi_square = 1.0;
  double share = 0.0;  ///< of the arcs, that the change is the mean of, in (0, 1]
};

/// A pixel that the outline may cross, told apart into ball and background.
struct UnmixedPixel {
  Eigen::Vector2d position_px = Eigen::Vector2d::Zero();
  double shown = 0.0;        ///< how much of the ball it shows
  double whole = 0.0;        ///< how much it would show if the ball covered it
  double distance_px = 0.0;  ///< from the outline that it was looked at for, positive outside
  std::size_t sector = 0;
};

/// Tells the pixels of usable arcs apart.
ScratchVector<UnmixedPixel> unmix(const Rim& rim, const ScratchVector<ArcColours>& colours);

/// Compares each arc's coverage with the model's.
/// @param ramp_half_width_px of the model's edge; 0 for what the picture makes of a sharp one
/// @param is_resampled whether the picture was interpolated
/// @return one for each arc, weight 1 where it says something
ScratchVector<ArcOffset> arc_offsets(const ScratchVector<UnmixedPixel>& pixels,
                                     const ScratchVector<ArcColours>& colours, const OutlineModel& outline,
                                     double ramp_half_width_px, bool is_resampled);

/// The offsets from an outline that has been changed, as long as the change is small.
void move_outline(ScratchVector<ArcOffset>& arcs, const Eigen::Vector3d& change_px);

/// Weighted least squares over the arcs; those at odds with the solution lose weight (Huber, then cut off).
/// @param arcs their weights are updated
/// @param tolerance_px offsets from the solution that are fine whatever the noise says
/// @return empty when the arcs left span less than a fifth of the outline
std::optional<OutlineStep> solve_arcs(ScratchVector<ArcOffset>& arcs, double tolerance_px);

}  // namespace stereobench::vision
