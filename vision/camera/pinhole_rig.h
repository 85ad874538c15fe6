/// The pinhole camera whose picture holds all that a lens sees.
#pragma once

#include <optional>

#include "vision/types.h"

namespace stereobench::vision {

/// Pixels that it has each way, at least and at most, for one of the lens's picture in the middle. A lens
/// that enlarges rows or columns towards the border has more, so that they have the least there, too.
inline constexpr double kLeastPinholeDensity = 1.45, kMostPinholeDensity = 2.0;

/// The most pixels that it may have each way to be drawn: two such pictures lie side by side.
inline constexpr int kLargestPinhole_px = 8192;

/// The rig without distortion, with more pixels, that sees all that a rig's lenses see.
/// @param rig usable (rig.h)
/// @return empty where the lens folds its picture; it may be larger than can be drawn
std::optional<StereoRig> pinhole_rig(const StereoRig& rig);

/// Whether a pinhole's picture can be drawn.
bool can_be_drawn(const Intrinsics& pinhole);

}  // namespace stereobench::vision
