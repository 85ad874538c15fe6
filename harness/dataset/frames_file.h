/// When the pictures of a data set were really taken, and from where.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "harness/drive/frame_choice.h"
#include "worlds/types.h"

namespace stereobench::harness {

/// When the pictures of a step are taken, and from where.
struct TakenPictures {
  std::size_t step = 0;
  double late_s = 0.0;          ///< by how much later than the step's time the cameras look
  slam::Pose world_from_robot;  ///< when the left one does: its middle row, halfway through the exposure
};

/// The steps that have pictures: those that are wanted but for what the shutter drops.
std::vector<TakenPictures> pictures_of(const worlds::Scenario& scenario, std::uint64_t seed,
                                       const FrameChoice& frames = {});

/// A line for each step of a drive: its number and time; whether there are pictures of it; by how much later
/// than that time the cameras looked; and the robot's true pose when the left one did (its middle row,
/// halfway through the exposure). Of a frame that the shutter drops, or that is not wanted, the last four are
/// empty.
/// @param frames of which there are pictures, unless the shutter drops them
/// @return CSV with a header
std::string frames_csv(const worlds::Scenario& scenario, std::uint64_t seed, const FrameChoice& frames = {});

}  // namespace stereobench::harness
