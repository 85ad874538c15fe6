/// When the pictures of a data set were really taken, and from where.
#pragma once

#include <cstdint>
#include <string>

#include "harness/drive/frame_choice.h"
#include "worlds/types.h"

namespace stereobench::harness {

/// A line for each step of a drive: its number and time; whether there are pictures of it; by how much later
/// than that time the cameras looked; and the robot's true pose when the left one did (its middle row,
/// halfway through the exposure). Of a frame that the shutter drops, or that is not wanted, the last four are
/// empty.
/// @param frames of which there are pictures, unless the shutter drops them
/// @return CSV with a header
std::string frames_csv(const worlds::Scenario& scenario, std::uint64_t seed, const FrameChoice& frames = {});

}  // namespace stereobench::harness
