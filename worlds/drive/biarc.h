/// Two arcs from one pose to another: the smooth way that a robot with constant velocities can drive.
#pragma once

#include <array>
#include <optional>

#include <Eigen/Core>

#include "slam/types.h"

namespace stereobench::worlds {

/// A piece of way of constant curvature; both are negative where it is driven backwards.
struct Arc {
  double length_m = 0.0;
  double turn_rad = 0.0;  ///< positive turns left
};

/// @return rad, of a direction of any length
double heading_of(const Eigen::Vector2d& direction);

/// The biarc whose two arcs have end tangents of equal length (Bolton 1975): it leaves one pose along its
/// heading and arrives at the other along its own, with no kink where the arcs meet. It is driven backwards
/// when the other pose lies behind.
///
/// @return empty when the poses share a place, or have one heading and lie exactly beside each other
std::optional<std::array<Arc, 2>> biarc(const slam::Pose& from, const slam::Pose& to);

}  // namespace stereobench::worlds
