/// Pictures of floats: portable float maps (PFM) and TIFF files.
#pragma once

#include <filesystem>

#include <opencv2/core.hpp>

namespace stereobench::harness {

/// Reads a PFM file, of either byte order, or a TIFF file as renderer/pictures/float_tiff.h has them.
/// @return CV_32FC1, or CV_32FC3 with blue first, the top row first
/// @throws std::runtime_error, one line, for a file that is missing, neither, or cut short, and for a PFM
/// that is longer than it says
cv::Mat read_float_picture(const std::filesystem::path& file);

}  // namespace stereobench::harness
