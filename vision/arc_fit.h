/// One Gauss-Newton step of an outline: what its arcs say together.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "vision/arc_colours.h"
#include "vision/outline_model.h"
#include "vision/rim.h"

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
};

/// Compares each arc's coverage with the model's.
/// @param ramp_half_width_px of the model's edge; 0 for the pixels' own box filter
/// @return one for each sector of the rim, weight 1 where the arc is usable
std::vector<ArcOffset> arc_offsets(const Rim& rim, const std::vector<ArcColours>& colours,
                                   const OutlineModel& outline, double ramp_half_width_px);

/// Weighted least squares over the arcs; those at odds with the solution lose weight (Huber, then cut off).
/// @param arcs their weights are updated
/// @param tolerance_px offsets from the solution that are fine whatever the noise says
/// @return empty when the arcs left span less than a third of the outline
std::optional<OutlineStep> solve_arcs(std::vector<ArcOffset>& arcs, double tolerance_px);

}  // namespace stereobench::vision
