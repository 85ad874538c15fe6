/// Angles: pi, and degrees.
#pragma once

#include <numbers>

namespace stereobench::slam {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kRadPerDegree = kPi / 180.0;
inline constexpr double kDegreesPerRad = 180.0 / kPi;

}  // namespace stereobench::slam
