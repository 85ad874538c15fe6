/// A stereo rig's calibration as `stereobench render` writes it.
#pragma once

#include <filesystem>

#include "vision/types.h"

namespace stereobench::harness {

/// Reads calibration.yaml: `image_width`, `image_height`, `K`, `baseline_m`; where they are left out, `D` is
/// zero, and the cameras (`robot_from_left_camera`, `robot_from_right_camera`) look level, at height 0.
/// @throws std::runtime_error, one line, for what is missing, of another shape, or no rig that can be
/// computed
///   with; also for lens distortion, which nothing here undoes
vision::StereoRig read_calibration(const std::filesystem::path& file);

}  // namespace stereobench::harness
