/// Two golden frames side by side, for people.
#pragma once

#include <string>

#include "harness/golden/golden_difference.h"

namespace stereobench::harness {

/// Draws both cameras' pictures: before, after, and the difference, amplified, on a dim picture of before.
/// Linear pictures are shown as sRGB, as screens expect. Above stands what changed.
/// @param title e.g. the name of the case
/// @param difference of these frames
/// @return the bytes of a PNG file
/// @throws std::invalid_argument where the frames are of different sizes
std::string draw_golden_difference(const std::string& title, const GoldenFrame& before,
                                   const GoldenFrame& after, const GoldenDifference& difference);

}  // namespace stereobench::harness
