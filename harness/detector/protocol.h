/// What a detector's program is told, as lines of JSON: one that says what it looks through, then one a
/// frame.
///
///     {"protocol": "stereobench-detector", "version": 1, "rig": {"width_px": 1024, ...},
///      "ball_radius_m": 0.06, "ball_radius_sd_m": 0.001, "rows_within_px": 10.0,
///      "palette_rgb": [[229, 0, 0], ...], "noise_sd_levels": 2.0, "encoding": "linear"}
///     {"frame": 0, "stamp_ns": 0, "left": "/tmp/.../000000_left.png", "right": "/tmp/.../000000_right.png"}
///
/// It answers each frame, and nothing else, with a line as in detection_lines.h.
#pragma once

#include <filesystem>
#include <string>

#include "harness/detector/detector.h"

namespace stereobench::harness {

/// A frame that a program is asked about.
struct FrameRequest {
  std::size_t frame = 0;
  std::int64_t stamp_ns = 0;
  std::filesystem::path left;  ///< PNG, 8-bit colour, as the camera stores it
  std::filesystem::path right;
};

/// The first line, without its end.
std::string setup_line(const DetectorSetup& setup);

/// What setup_line made a line of, exactly.
/// @throws BadLine when it is none
DetectorSetup read_setup(const std::string& line);

/// A frame's line, without its end.
std::string request_line(const FrameRequest& request);

/// What request_line made a line of.
/// @throws BadLine when it is none
FrameRequest read_request(const std::string& line);

}  // namespace stereobench::harness
