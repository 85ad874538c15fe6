/// Golden frames as files: few, small pictures, and a file of hashes that decides before they are read.
///
///     seed0_step0012.json          sizes and SHA-256 of the pixels
///     seed0_step0012_left.png      what the camera stores, without noise, in small; and _right.png
///     seed0_step0012_left_shown.png  which surface each pixel shows: red + 256 green; and _right_shown.png
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "harness/golden/golden_difference.h"
#include "harness/golden/golden_frame.h"
#include "harness/golden/golden_limits.h"

namespace stereobench::harness {

/// The names of a frame's files in its folder.
std::vector<std::string> golden_file_names(const FrameName& frame);

/// Writes a frame's files, the one with the hashes last. The same frame gives the same bytes.
/// @param folder is made where it is missing
/// @throws std::runtime_error when a file cannot be written
void write_golden(const std::filesystem::path& folder, const GoldenFrame& frame);

/// Reads all of a frame.
/// @throws std::runtime_error, one line that names the file: missing, broken, of another size, or not the
///   picture that was written
GoldenFrame read_golden(const std::filesystem::path& folder, const FrameName& frame);

/// What became of a golden frame.
struct GoldenCheck {
  GoldenDifference difference;
  std::optional<GoldenFrame> before;  ///< where something changed
};

/// Compares a frame with the golden one of its name. Hashes decide first: where they are equal, no picture is
/// read.
/// @throws std::runtime_error as read_golden and compare_golden
GoldenCheck check_golden(const std::filesystem::path& folder, const GoldenFrame& now,
                         const GoldenLimits& limits);

}  // namespace stereobench::harness
