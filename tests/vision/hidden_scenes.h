/// Painted balls of which a part is hidden by a wall's edge, by a nearer ball, or lies beyond the picture's
/// border.
#pragma once

#include <cstdint>
#include <ostream>

#include "tests/vision/painter.h"

namespace stereobench::vision::painter {

enum class Hider { kEdge, kBall, kBorder };

/// For names of tests.
inline void PrintTo(Hider hider, std::ostream* out) {
  *out << (hider == Hider::kEdge ? "by an edge" : hider == Hider::kBall ? "by a ball" : "by the border");
}

inline constexpr double kHiddenRadius_m = 0.05;
inline constexpr double kHiddenNoise_levels = 2.0;
inline constexpr std::uint64_t kHiddenSeeds = 150;

StereoRig rig_of_hidden_balls();

/// A ball 1 to 4 m away, the first of the scene's, with something before it; how much of it that hides is
/// drawn.
Scene hidden_scene(Hider hider, const StereoRig& rig, std::uint64_t seed);

/// Whether between 10 and 70 % of a scene's first ball are hidden.
bool is_partly_hidden(double visible_share);

/// Of range and bearing, measured minus true.
Eigen::Vector2d range_bearing_error(const BallObservation& seen, const PaintedBall& ball,
                                    const StereoRig& rig);

/// 5 mm up to 3 m, and growing with the depth beyond as errors of range do.
double allowed_range_error_m(double depth_m);

}  // namespace stereobench::vision::painter
