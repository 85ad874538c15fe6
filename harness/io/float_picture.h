/// Pictures of floats: portable float maps (PFM).
#pragma once

#include <filesystem>

#include <opencv2/core.hpp>

namespace stereobench::harness {

/// Reads a PFM file, of either byte order.
/// @return CV_32FC1, or CV_32FC3 with blue first, the top row first
/// @throws std::runtime_error, one line, for a file that is missing, no PFM, cut short, or longer than it
/// says
cv::Mat read_float_picture(const std::filesystem::path& file);

}  // namespace stereobench::harness
