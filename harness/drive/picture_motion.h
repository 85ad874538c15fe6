/// How fast what a picture shows moves through it.
#pragma once

#include <cstddef>

#include "renderer/types.h"
#include "vision/types.h"
#include "worlds/types.h"

namespace stereobench::harness {

/// While a step's shutter is open.
struct Exposure {
  const worlds::GroundTruth& path;
  std::size_t index = 0;       ///< of the step
  double middle_s = 0.0;       ///< halfway, since the step's time
  double open_s = 0.0;         ///< how long, > 0
  double right_delay_s = 0.0;  ///< of the right camera's shutter behind the left one's
};

/// The longest way that a point of the picture goes while the shutter is open: its largest speed at the
/// beginning, halfway and at the end, times the time. Looked at are every eighth row and column, each point
/// as far away as the picture halfway says.
/// @param middle what both cameras see halfway
/// @param rig as it is
/// @return pixels; 0 where the robot stands still
double longest_way_px(const renderer::StereoFrame& middle, const vision::StereoRig& rig,
                      const Exposure& exposure);

}  // namespace stereobench::harness
