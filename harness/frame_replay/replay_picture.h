/// A frame that was rendered again, for people to look at.
#pragma once

#include <string>

#include "harness/frame_replay/frame_replay.h"

namespace stereobench::harness {

/// Draws what was detected, and the border of each ball's pixels: blue where the ball was found or need not
/// be, red where it was missed.
/// @return the bytes of a PNG file
std::string draw_replay_picture(const ReplayedFrame& frame);

}  // namespace stereobench::harness
