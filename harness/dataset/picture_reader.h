/// Pictures from anywhere, as the vision stage takes them.
#pragma once

#include <filesystem>

#include <opencv2/core.hpp>

namespace stereobench::harness {

/// Reads a picture of any format that there is a reader for (renderer/picture_reader.h).
/// @return CV_8UC1 or CV_8UC3 (BGR), as the file has colours or not
/// @throws std::runtime_error, one line, for a file that is missing, no picture, or cut short
cv::Mat read_levels(const std::filesystem::path& file);

/// The same, which has to have colours.
/// @return CV_8UC3, BGR
/// @throws std::runtime_error, one line, as read_levels does, and without colour
cv::Mat read_picture(const std::filesystem::path& file);

/// The same as grey levels, for what is found by shape; pictures without colour are welcome.
/// @return CV_8UC1
/// @throws std::runtime_error as read_levels does
cv::Mat read_grey_picture(const std::filesystem::path& file);

/// Whether a file's name says that it is a picture.
bool is_picture_name(const std::filesystem::path& file);

}  // namespace stereobench::harness
