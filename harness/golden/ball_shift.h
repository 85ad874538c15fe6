/// By how much balls moved from one picture to another, to a fraction of a pixel.
#pragma once

#include <vector>

#include "harness/golden/golden_difference.h"

namespace stereobench::harness {

/// The shifts of balls of which both pictures show 30 pixels or more, the largest first; balls that did not
/// move are left out.
std::vector<BallShift> ball_shifts(const GoldenPicture& before, const GoldenPicture& after);

}  // namespace stereobench::harness
